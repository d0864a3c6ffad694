// SPDX-License-Identifier: Apache-2.0
// libcamera as C functions: see the header. The only C++ of the project: it decides nothing.
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <libcamera/libcamera.h>

#include "hal/linux/camera_libcamera.h"

using namespace libcamera;

struct libcamera_session {
    CameraManager manager;
    std::shared_ptr<Camera> camera; /* acquired */
    std::unique_ptr<CameraConfiguration> configuration;
    std::unique_ptr<FrameBufferAllocator> allocator;
    std::vector<std::unique_ptr<Request>> requests; /* by buffer; its number is the cookie */
    libcamera_events_t events = {};
    bool started = false;

    void on_completed(Request *request)
    {
        if (request->status() != Request::RequestCancelled)
            events.filled(events.context, static_cast<int>(request->cookie()));
    }

    void on_disconnected()
    {
        events.gone(events.context);
    }

    void disconnect()
    {
        if (!camera)
            return;
        camera->requestCompleted.disconnect(this);
        camera->disconnected.disconnect(this);
    }

    Stream *stream() const
    {
        return configuration->at(0).stream();
    }
};

namespace
{

/* Call what may throw. */
template <typename Function> int guarded(const Function &function) noexcept
{
    try {
        return function();
    } catch (const std::bad_alloc &) {
        return -ENOMEM;
    } catch (...) {
        return -EIO;
    }
}

template <size_t length> void copy(char (&to)[length], const std::string &from)
{
    (void)std::snprintf(to, length, "%s", from.c_str());
}

libcamera_colours_t colours_of(const std::optional<ColorSpace> &space)
{
    if (!space)
        return LIBCAMERA_UNTOLD;
    if (space->range != ColorSpace::Range::Limited)
        return LIBCAMERA_OTHER_COLOURS;
    switch (space->ycbcrEncoding) {
    case ColorSpace::YcbcrEncoding::Rec601:
        return LIBCAMERA_BT601;
    case ColorSpace::YcbcrEncoding::Rec709:
        return LIBCAMERA_BT709;
    default:
        return LIBCAMERA_OTHER_COLOURS;
    }
}

libcamera_buffer_t buffer_of(const FrameBuffer &frame)
{
    libcamera_buffer_t buffer = {};
    if (frame.planes().size() > PICTURE_MAX_PLANES)
        return buffer;
    for (const auto &plane : frame.planes())
        buffer.piece[buffer.count++] = {plane.fd.get(), plane.offset, plane.length};
    return buffer;
}

} /* namespace */

int libcamera_open(libcamera_session_t **session)
{
    return guarded([&] {
        auto made = std::make_unique<libcamera_session>();
        const int failure = made->manager.start();
        if (failure == 0)
            *session = made.release();
        return failure;
    });
}

void libcamera_close(libcamera_session_t *session)
{
    (void)guarded([&] {
        if (session->started)
            session->camera->stop(); /* all requests are cancelled when it returns */
        session->disconnect();
        session->requests.clear();
        session->allocator.reset();
        session->configuration.reset();
        if (session->camera)
            session->camera->release();
        session->camera.reset();
        session->manager.stop();
        return 0;
    });
    delete session;
}

void libcamera_abandon(libcamera_session_t *session)
{
    (void)guarded([&] {
        session->disconnect();
        return 0;
    });
}

int libcamera_count(const libcamera_session_t *session)
{
    return guarded([&] { return static_cast<int>(session->manager.cameras().size()); });
}

void libcamera_name(const libcamera_session_t *session, int camera, libcamera_name_t *name)
{
    *name = {};
    (void)guarded([&] {
        const auto found = session->manager.cameras().at(static_cast<size_t>(camera));
        const auto model = found->properties().get(properties::Model);
        copy(name->id, found->id());
        copy(name->model, model ? std::string(*model) : "");
        return 0;
    });
}

int libcamera_try(libcamera_session_t *session, int camera, const libcamera_format_t *wish, unsigned buffers,
                  libcamera_format_t *given)
{
    return guarded([&] {
        const auto asked = session->manager.cameras().at(static_cast<size_t>(camera));
        session->configuration = asked->generateConfiguration({StreamRole::VideoRecording});
        if (!session->configuration || session->configuration->empty())
            return -ENODEV;
        StreamConfiguration &stream = session->configuration->at(0);
        stream.pixelFormat = PixelFormat(wish->fourcc);
        stream.size = {wish->width, wish->height};
        stream.bufferCount = buffers;
        if (wish->colours == LIBCAMERA_BT709)
            stream.colorSpace = ColorSpace::Rec709;
        if (session->configuration->validate() == CameraConfiguration::Invalid)
            return -EINVAL;
        *given = {};
        given->fourcc = stream.pixelFormat.fourcc();
        given->width = stream.size.width;
        given->height = stream.size.height;
        given->colours = colours_of(stream.colorSpace);
        copy(given->colours_text, ColorSpace::toString(stream.colorSpace));
        return stream.pixelFormat.modifier() == 0 ? 0 : -EINVAL;
    });
}

int libcamera_acquire(libcamera_session_t *session, int camera)
{
    return guarded([&] {
        auto wanted = session->manager.cameras().at(static_cast<size_t>(camera));
        const int failure = wanted->acquire();
        if (failure == 0)
            session->camera = std::move(wanted);
        return failure;
    });
}

int libcamera_configure(libcamera_session_t *session, uint32_t *stride)
{
    return guarded([&] {
        const int failure = session->camera->configure(session->configuration.get());
        *stride = session->configuration->at(0).stride;
        return failure;
    });
}

int libcamera_make_buffers(libcamera_session_t *session, libcamera_buffer_t *buffers, int most)
{
    return guarded([&] {
        session->allocator = std::make_unique<FrameBufferAllocator>(session->camera);
        const int count = session->allocator->allocate(session->stream());
        for (int i = 0; i < count && i < most; i++) {
            const auto &frame = session->allocator->buffers(session->stream())[static_cast<size_t>(i)];
            auto request = session->camera->createRequest(static_cast<uint64_t>(i));
            if (!request)
                return -ENOMEM;
            const int failure = request->addBuffer(session->stream(), frame.get());
            if (failure != 0)
                return failure;
            buffers[i] = buffer_of(*frame);
            session->requests.push_back(std::move(request));
        }
        return count;
    });
}

int libcamera_start(libcamera_session_t *session, const libcamera_events_t *events, int64_t interval_us)
{
    return guarded([&] {
        Camera &camera = *session->camera;
        session->events = *events;
        camera.requestCompleted.connect(session, &libcamera_session::on_completed);
        camera.disconnected.connect(session, &libcamera_session::on_disconnected);
        ControlList controls(camera.controls());
        const std::array<int64_t, 2> limits = {interval_us, interval_us};
        if (camera.controls().count(&controls::FrameDurationLimits) != 0)
            controls.set(controls::FrameDurationLimits, Span<const int64_t, 2>(limits));
        const int failure = camera.start(&controls);
        session->started = failure == 0;
        return failure;
    });
}

int libcamera_queue(libcamera_session_t *session, int buffer)
{
    return guarded([&] {
        Request &request = *session->requests.at(static_cast<size_t>(buffer));
        request.reuse(Request::ReuseBuffers);
        return session->camera->queueRequest(&request);
    });
}

void libcamera_result(const libcamera_session_t *session, int buffer, libcamera_result_t *result)
{
    *result = {};
    (void)guarded([&] {
        Request &request = *session->requests.at(static_cast<size_t>(buffer));
        const FrameMetadata &about = request.findBuffer(session->stream())->metadata();
        const auto sensor_ns = request.metadata().get(controls::SensorTimestamp);
        result->good = about.status == FrameMetadata::FrameSuccess;
        result->stamp_us = (sensor_ns ? *sensor_ns : static_cast<int64_t>(about.timestamp)) / 1000;
        result->sequence = about.sequence;
        return 0;
    });
}
