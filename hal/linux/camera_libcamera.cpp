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

#include <linux/dma-buf.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <libcamera/libcamera.h>

extern "C" {
#include "hal/linux/camera_clock.h"
#include "hal/linux/camera_libcamera.h"
#include "hal/linux/camera_unplugged.h"
}

namespace
{

constexpr int poll_ms = 500, least_buffers = 4; /* some pipelines have no more */
constexpr int64_t lost_us = 5000000;

struct format_t {
    libcamera::PixelFormat fourcc;
    picture_format_t format;
};

/* The best first: full colour, then the fewest bytes. libcamera's names are DRM's, as ours. */
constexpr std::array<format_t, 6> formats = {{
    {libcamera::formats::XRGB8888, PICTURE_XRGB8888},
    {libcamera::formats::RGB888, PICTURE_RGB888},
    {libcamera::formats::BGR888, PICTURE_BGR888},
    {libcamera::formats::YUYV, PICTURE_YUYV},
    {libcamera::formats::UYVY, PICTURE_UYVY},
    {libcamera::formats::NV12, PICTURE_NV12},
}};

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
    bool acquired = false, started = false;
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

libcamera::StreamConfiguration &stream_of(const device_t &device)
{
    return device.configuration->at(0);
}

/* A pass of the CPU over the memory of a buffer begins or ends; the planes may share it. */
void sync_caches(const libcamera::FrameBuffer &buffer, uint64_t edge)
{
    for (const auto &plane : buffer.planes()) {
        struct dma_buf_sync sync = {edge | DMA_BUF_SYNC_READ};
        (void)ioctl(plane.fd.get(), DMA_BUF_IOCTL_SYNC, &sync); /* refused where there is nothing to do */
    }
}

bool choose_camera(device_t &device, char error[HAL_BOARD_ERROR_LENGTH])
{
    const std::string which = device.wanted.name.which;
    const auto cameras = device.manager->cameras();
    for (size_t i = 0; i < cameras.size() && !device.camera; i++) {
        const auto model = cameras[i]->properties().get(libcamera::properties::Model);
        if (which == std::to_string(i) || which == cameras[i]->id() || (model && which == *model))
            device.camera = cameras[i];
    }
    if (!device.camera)
        return camera_fail(error, "is not among the %zu cameras here; plug it in, or choose one that `cam -l` lists",
                           cameras.size());
    const int failure = device.camera->acquire();
    if (failure != 0)
        return camera_fail(error, failure == -EBUSY ? "is used by another program; close that" : "can't be had: %s",
                           strerror(-failure));
    device.acquired = true;
    return true;
}

/* BT.601 or BT.709, of limited range; a pipeline that says nothing means V4L2's default, BT.601. */
bool judge_colours(device_t &device, char error[HAL_BOARD_ERROR_LENGTH])
{
    using libcamera::ColorSpace;
    const auto &space = stream_of(device).colorSpace;
    device.picture.matrix =
        space && space->ycbcrEncoding == ColorSpace::YcbcrEncoding::Rec709 ? PICTURE_BT709 : PICTURE_BT601;
    if (!picture_is_yuv(device.picture.format) || !space)
        return true;
    if (space->range == ColorSpace::Range::Limited && (space->ycbcrEncoding == ColorSpace::YcbcrEncoding::Rec709 ||
                                                       space->ycbcrEncoding == ColorSpace::YcbcrEncoding::Rec601))
        return true;
    return camera_fail(error, "gives colours %s, expected BT.601 or BT.709 of limited range; try another format",
                       space->toString().c_str());
}

bool try_format(device_t &device, const format_t &format, char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *name = camera_format_name(format.format);
    const auto width = static_cast<unsigned>(device.wanted.width), height = static_cast<unsigned>(device.wanted.height);
    device.configuration = device.camera->generateConfiguration({libcamera::StreamRole::VideoRecording});
    if (!device.configuration || device.configuration->empty())
        return camera_fail(error, "has no video stream; choose another camera of `cam -l`");
    libcamera::StreamConfiguration &stream = stream_of(device);
    stream.pixelFormat = format.fourcc;
    stream.size = {width, height};
    stream.bufferCount = CAMERA_BUFFERS;
    if (picture_is_yuv(format.format))
        stream.colorSpace = libcamera::ColorSpace::Rec709;
    if (device.configuration->validate() == libcamera::CameraConfiguration::Invalid)
        return camera_fail(error, "has no valid configuration for %s; see `cam -c 1 -I`", name);
    if (stream.pixelFormat != format.fourcc)
        return false; /* an earlier reason may tell more */
    if (stream.size.width != width || stream.size.height != height)
        return camera_fail(error, "gives %s of %ux%u at nearest, expected %ux%u as the room file states", name,
                           stream.size.width, stream.size.height, width, height);
    device.picture = {};
    device.picture.format = format.format;
    device.picture.width = device.wanted.width;
    device.picture.height = device.wanted.height;
    return judge_colours(device, error);
}

bool configure(device_t &device, char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)camera_fail(error, "gives none of the formats that are wanted; see `cam -c 1 -I` and README.md");
    const camera_name_t &name = device.wanted.name;
    const bool found = std::any_of(formats.begin(), formats.end(), [&](const format_t &format) {
        return (name.any_format || name.format == format.format) && try_format(device, format, error);
    });
    if (!found)
        return false;
    const int failure = device.camera->configure(device.configuration.get());
    if (failure != 0)
        return camera_fail(error, "can't be configured: %s; see LIBCAMERA_LOG_LEVELS=*:DEBUG", strerror(-failure));
    const unsigned stride = stream_of(device).stride;
    device.picture.stride[0] = device.picture.stride[1] = stride > INT_MAX ? 0 : static_cast<int32_t>(stride);
    return picture_is_valid(&device.picture) ||
           camera_fail(error, "gives rows of %u bytes, which no picture has", stride);
}

/* Where the planes of a picture are in a buffer: the memory of each plane, from the start of its file. */
size_t end_of(const libcamera::FrameBuffer::Plane &plane)
{
    return size_t{plane.offset} + plane.length;
}

bool map_buffer(device_t &device, const libcamera::FrameBuffer &buffer, int number, char error[HAL_BOARD_ERROR_LENGTH])
{
    const auto &planes = buffer.planes();
    const size_t luma = static_cast<size_t>(device.picture.stride[0]) * static_cast<size_t>(device.picture.height);
    const bool chroma_apart = device.picture.format == PICTURE_NV12 && planes.size() == 2;
    const size_t first = luma + (device.picture.format == PICTURE_NV12 && !chroma_apart ? luma / 2 : 0);
    if (planes.size() != (chroma_apart ? 2U : 1U) || planes[0].length < first ||
        (chroma_apart && planes[1].length < luma / 2))
        return camera_fail(error, "has buffers too small for the picture");
    camera_map_t map[PICTURE_MAX_PLANES] = {};
    for (size_t i = 0; i < planes.size(); i++) {
        void *address = mmap(nullptr, end_of(planes[i]), PROT_READ, MAP_SHARED, planes[i].fd.get(), 0);
        if (address == MAP_FAILED) {
            if (i == 1)
                (void)munmap(map[0].address, map[0].length);
            return camera_fail(error, "can't map buffer %d: %s", number, strerror(errno));
        }
        map[i] = {address, end_of(planes[i])};
    }
    camera_exchange_map(device.wanted.exchange, number, map);
    return true;
}

bool make_buffers(device_t &device, char error[HAL_BOARD_ERROR_LENGTH])
{
    libcamera::Stream *stream = stream_of(device).stream();
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
        if (!map_buffer(device, *buffer, number, error))
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
    if (device.acquired)
        device.camera->release();
    device.acquired = false;
    device.camera.reset();
    if (device.manager)
        device.manager->stop();
    device.manager.reset();
    device.completed.count = 0;
    device.completed.gone = device.stuck = false;
}

const libcamera::FrameBuffer &buffer_of(const device_t &device, const libcamera::Request &request)
{
    return *request.findBuffer(stream_of(device).stream());
}

bool queue_again(device_t &device, int number)
{
    libcamera::Request &request = *device.requests[static_cast<size_t>(number)];
    sync_caches(buffer_of(device, request), DMA_BUF_SYNC_END);
    request.reuse(libcamera::Request::ReuseBuffers);
    return device.camera->queueRequest(&request) == 0;
}

/* Hand the picture of a request to the loop, or the request back to the camera when it has none. */
bool deliver(device_t &device, libcamera::Request &request)
{
    const int number = static_cast<int>(request.cookie());
    const libcamera::FrameBuffer &buffer = buffer_of(device, request);
    const libcamera::FrameMetadata &about = buffer.metadata();
    sync_caches(buffer, DMA_BUF_SYNC_START);
    if (about.status != libcamera::FrameMetadata::FrameSuccess)
        return queue_again(device, number);
    const auto sensor_ns = request.metadata().get(libcamera::controls::SensorTimestamp);
    const int64_t stamp_us = (sensor_ns ? *sensor_ns : static_cast<int64_t>(about.timestamp)) / 1000;
    hal_camera_frame_t frame = {
        device.picture, camera_stamp_us(stamp_us, camera_now_us(), camera_clock_us(CLOCK_BOOTTIME)), about.sequence};
    const auto &planes = buffer.planes();
    for (size_t i = 0; i < planes.size(); i++) {
        const camera_map_t memory = camera_exchange_memory(device.wanted.exchange, number, static_cast<int>(i));
        frame.picture.data[i] = static_cast<uint8_t *>(memory.address) + planes[i].offset;
    }
    if (device.picture.format == PICTURE_NV12 && planes.size() == 1)
        frame.picture.data[1] =
            frame.picture.data[0] + ptrdiff_t{device.picture.stride[0]} * ptrdiff_t{device.picture.height};
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
        return choose_camera(device, error) && configure(device, error) && make_buffers(device, error) &&
               start(device, error);
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
