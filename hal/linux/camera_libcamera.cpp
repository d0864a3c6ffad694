// SPDX-License-Identifier: Apache-2.0
// Video through libcamera: see the header. Nothing that is thrown leaves this file.
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <poll.h>
#include <unistd.h>

#include <libcamera/libcamera.h>

#include "hal/linux/camera_libcamera_choice.hpp"

extern "C" {
#include "hal/linux/camera_clock.h"
#include "hal/linux/camera_dmabuf.h"
#include "hal/linux/camera_libcamera.h"
#include "hal/linux/camera_unplugged.h"
}

namespace
{

constexpr int poll_ms = 500, least_buffers = 4; /* some pipelines have no more */
constexpr int64_t lost_us = 5000000;

/* From the library's threads to ours. */
struct completed_t {
    std::mutex mutex;
    std::array<libcamera::Request *, CAMERA_BUFFERS_MAX> request;
    size_t count = 0;
    bool gone = false; /* unplugged, as the library says */
};

struct device_t {
    camera_wanted_t wanted;
    completed_t completed;
    std::unique_ptr<libcamera::CameraManager> manager;
    std::shared_ptr<libcamera::Camera> camera;
    std::unique_ptr<libcamera::CameraConfiguration> configuration;
    std::unique_ptr<libcamera::FrameBufferAllocator> allocator;
    std::vector<std::unique_ptr<libcamera::Request>> requests; /* by buffer; its number is the cookie */
    bool started = false;
    bool stuck = false; /* unplugged, and the library does not know */
    picture_t picture;  /* without data */
    int64_t picture_us; /* when the last one came, or the device began */

    void wake()
    {
        const uint64_t one = 1;
        if (write(wanted.wake, &one, sizeof one) < 0)
            return; /* so many wait that it wakes anyway */
    }

    void on_completed(libcamera::Request *request)
    {
        if (request->status() == libcamera::Request::RequestCancelled)
            return;
        {
            const std::lock_guard<std::mutex> lock(completed.mutex);
            if (completed.count < completed.request.size())
                completed.request[completed.count++] = request;
        }
        wake();
    }

    void on_disconnected()
    {
        {
            const std::lock_guard<std::mutex> lock(completed.mutex);
            completed.gone = true;
        }
        wake();
    }
};

/* Call what may throw. */
template <typename Function> bool guarded(char error[HAL_BOARD_ERROR_LENGTH], const Function &function)
{
    try {
        return function();
    } catch (const std::exception &exception) {
        return camera_fail(error, "libcamera failed: %s", exception.what());
    } catch (...) {
        return camera_fail(error, "libcamera failed, and did not say why");
    }
}

libcamera::Stream *stream_of(const device_t &device)
{
    return device.configuration->at(0).stream();
}

struct pieces_t {
    std::array<camera_dmabuf_t, PICTURE_MAX_PLANES> piece;
    size_t count; /* 0: more than a picture has */
};

pieces_t pieces_of(const libcamera::FrameBuffer &buffer)
{
    pieces_t pieces = {};
    for (const auto &plane : buffer.planes())
        if (pieces.count < pieces.piece.size())
            pieces.piece[pieces.count++] = {plane.fd.get(), plane.offset, plane.length};
    if (buffer.planes().size() > pieces.piece.size())
        pieces.count = 0;
    return pieces;
}

bool make_buffers(device_t &device, char error[HAL_BOARD_ERROR_LENGTH])
{
    libcamera::Stream *stream = stream_of(device);
    device.allocator = std::make_unique<libcamera::FrameBufferAllocator>(device.camera);
    const int count = device.allocator->allocate(stream);
    if (count < least_buffers || count > CAMERA_BUFFERS_MAX)
        return camera_fail(error, "has %d buffers, expected %d to %d; give it more memory (cma= of the kernel)", count,
                           least_buffers, CAMERA_BUFFERS_MAX);
    for (const auto &buffer : device.allocator->buffers(stream)) {
        const int number = static_cast<int>(device.requests.size());
        auto request = device.camera->createRequest(static_cast<uint64_t>(number));
        if (!request || request->addBuffer(stream, buffer.get()) != 0)
            return camera_fail(error, "makes no request for buffer %d; see LIBCAMERA_LOG_LEVELS=*:DEBUG", number);
        const pieces_t pieces = pieces_of(*buffer);
        if (!camera_dmabuf_map(device.wanted.exchange, number, pieces.piece.data(), pieces.count, &device.picture,
                               error))
            return false;
        device.requests.push_back(std::move(request));
    }
    return true;
}

bool start(device_t &device, char error[HAL_BOARD_ERROR_LENGTH])
{
    const camera_wanted_t &wanted = device.wanted;
    device.camera->requestCompleted.connect(&device, &device_t::on_completed);
    device.camera->disconnected.connect(&device, &device_t::on_disconnected);
    libcamera::ControlList controls(device.camera->controls());
    const int64_t interval_us = int64_t{1000000} * wanted.rate_seconds / wanted.rate_frames;
    const std::array<int64_t, 2> limits = {interval_us, interval_us};
    if (device.camera->controls().count(&libcamera::controls::FrameDurationLimits) != 0)
        controls.set(libcamera::controls::FrameDurationLimits, libcamera::Span<const int64_t, 2>(limits));
    const int failure = device.camera->start(&controls);
    if (failure != 0)
        return camera_fail(error, "does not start: %s; see `dmesg`", strerror(-failure));
    device.started = true;
    device.picture_us = camera_now_us();
    for (const auto &request : device.requests)
        if (device.camera->queueRequest(request.get()) != 0)
            return camera_fail(error, "does not take its buffers; see LIBCAMERA_LOG_LEVELS=*:DEBUG");
    return true;
}

void close_all(device_t &device)
{
    if (device.started)
        device.camera->stop(); /* all requests are cancelled when it returns */
    device.started = false;
    if (device.camera) {
        device.camera->requestCompleted.disconnect(&device);
        device.camera->disconnected.disconnect(&device);
    }
    camera_exchange_withdraw(device.wanted.exchange);
    device.requests.clear();
    device.allocator.reset();
    device.configuration.reset();
    if (device.camera)
        device.camera->release();
    device.camera.reset();
    if (device.manager)
        device.manager->stop();
    device.manager.reset();
    device.completed.count = 0;
    device.completed.gone = device.stuck = false;
}

const libcamera::FrameBuffer &buffer_of(const device_t &device, const libcamera::Request &request)
{
    return *request.findBuffer(stream_of(device));
}

bool queue_again(device_t &device, int number)
{
    libcamera::Request &request = *device.requests[static_cast<size_t>(number)];
    for (const auto &plane : buffer_of(device, request).planes())
        camera_dmabuf_end_read(plane.fd.get());
    request.reuse(libcamera::Request::ReuseBuffers);
    return device.camera->queueRequest(&request) == 0;
}

/* Hand the picture of a request to the loop, or the request back to the camera when it has none. */
bool deliver(device_t &device, libcamera::Request &request)
{
    const int number = static_cast<int>(request.cookie());
    const libcamera::FrameBuffer &buffer = buffer_of(device, request);
    const libcamera::FrameMetadata &about = buffer.metadata();
    for (const auto &plane : buffer.planes())
        camera_dmabuf_begin_read(plane.fd.get());
    if (about.status != libcamera::FrameMetadata::FrameSuccess)
        return queue_again(device, number);
    const auto sensor_ns = request.metadata().get(libcamera::controls::SensorTimestamp);
    const int64_t stamp_us = (sensor_ns ? *sensor_ns : static_cast<int64_t>(about.timestamp)) / 1000;
    hal_camera_frame_t frame = {
        device.picture, camera_stamp_us(stamp_us, camera_now_us(), camera_clock_us(CLOCK_BOOTTIME)), about.sequence};
    const pieces_t pieces = pieces_of(buffer);
    camera_dmabuf_place(&frame.picture, device.wanted.exchange, number, pieces.piece.data(), pieces.count);
    device.picture_us = camera_now_us();
    const int older = camera_exchange_put(device.wanted.exchange, number, &frame);
    return older == CAMERA_NO_BUFFER || queue_again(device, older);
}

/* @return false when the camera failed. */
bool serve_once(device_t &device)
{
    std::array<libcamera::Request *, CAMERA_BUFFERS_MAX> completed;
    size_t count;
    {
        const std::lock_guard<std::mutex> lock(device.completed.mutex);
        completed = device.completed.request;
        count = device.completed.count;
        device.completed.count = 0;
    }
    for (int i = 0; i < CAMERA_BUFFERS_MAX; i++) {
        const int returned = camera_exchange_collect(device.wanted.exchange);
        if (returned == CAMERA_NO_BUFFER)
            break;
        if (!queue_again(device, returned))
            return false;
    }
    for (size_t i = 0; i < count; i++)
        if (!deliver(device, *completed[i]))
            return false;
    return true;
}

/* ---- camera_source_t ---- */

void *create(const camera_wanted_t *wanted)
{
    void *made = nullptr;
    char error[HAL_BOARD_ERROR_LENGTH];
    (void)guarded(error, [&] {
        auto device = std::make_unique<device_t>();
        device->wanted = *wanted;
        (void)setenv("LIBCAMERA_LOG_LEVELS", "*:ERROR", 0);
        made = device.release();
        return true;
    });
    return made;
}

bool is_gone(device_t &device)
{
    const std::lock_guard<std::mutex> lock(device.completed.mutex);
    return device.completed.gone;
}

/*
 * The library ends the program when it stops a camera that is no longer there, unless its pipeline knows of unplugging:
 * USB's alone does. Such a camera is left as it is.
 */
void close_device(void *source)
{
    char error[HAL_BOARD_ERROR_LENGTH];
    device_t &device = *static_cast<device_t *>(source);
    (void)guarded(error, [&] {
        if (device.stuck && !is_gone(device)) {
            device.camera->requestCompleted.disconnect(&device);
            device.camera->disconnected.disconnect(&device);
        } else {
            close_all(device);
        }
        return true;
    });
}

bool open_device(void *source, char error[HAL_BOARD_ERROR_LENGTH])
{
    device_t &device = *static_cast<device_t *>(source);
    const bool good = guarded(error, [&] {
        device.manager = std::make_unique<libcamera::CameraManager>();
        const int failure = device.manager->start();
        if (failure != 0)
            return camera_fail(error, "libcamera does not start: %s; see `cam -l`", strerror(-failure));
        const camera_wanted_t &wanted = device.wanted;
        device.camera = libcamera_choose(*device.manager, wanted.name.which, error);
        if (!device.camera)
            return false;
        device.configuration = libcamera_configure(*device.camera, wanted, device.picture, error);
        return device.configuration && make_buffers(device, error) && start(device, error);
    });
    if (!good)
        close_device(source);
    return good;
}

bool serve(void *source, char news[HAL_BOARD_ERROR_LENGTH])
{
    device_t &device = *static_cast<device_t *>(source);
    struct pollfd waits = {device.wanted.wake, POLLIN, 0};
    (void)poll(&waits, 1, poll_ms);
    camera_wake_clear(device.wanted.wake);
    return guarded(news, [&] {
        const bool good = device.stuck || serve_once(device);
        const int64_t silent_us = camera_now_us() - device.picture_us;
        if (is_gone(device))
            return camera_fail(news, "is gone; plug it in again");
        device.stuck |= (!good || silent_us > 1000 * poll_ms) && camera_unplugged();
        if (device.stuck) {
            camera_exchange_withdraw(device.wanted.exchange);
            return !camera_fail(news, "is gone, and libcamera can't have it back; restart this program");
        }
        if (!good)
            return camera_fail(news, "failed; see `dmesg`");
        return silent_us <= lost_us ||
               camera_fail(news, "gave no picture for %d s; see `dmesg`", static_cast<int>(lost_us / 1000000));
    });
}

void destroy(void *source)
{
    device_t *device = static_cast<device_t *>(source);
    if (!device->stuck)
        delete device;
}

} /* namespace */

const camera_source_t camera_libcamera = {create, open_device, serve, close_device, destroy};
