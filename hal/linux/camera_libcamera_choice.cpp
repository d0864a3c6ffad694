// SPDX-License-Identifier: Apache-2.0
// Which of libcamera's cameras is meant, and the format of its pictures: see the header.
#include "hal/linux/camera_libcamera_choice.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstring>

#include <libcamera/libcamera.h>

std::shared_ptr<libcamera::Camera> libcamera_choose(const libcamera::CameraManager &manager, const std::string &which,
                                                    char error[HAL_BOARD_ERROR_LENGTH])
{
    std::shared_ptr<libcamera::Camera> chosen;
    const auto cameras = manager.cameras();
    for (size_t i = 0; i < cameras.size() && !chosen; i++) {
        const auto model = cameras[i]->properties().get(libcamera::properties::Model);
        if (which == std::to_string(i) || which == cameras[i]->id() || (model && which == *model))
            chosen = cameras[i];
    }
    if (!chosen) {
        (void)camera_fail(error,
                          "is not among the %zu cameras here; plug it in, end other programs that use it, or choose "
                          "one that `cam -l` "
                          "lists",
                          cameras.size());
        return nullptr;
    }
    const int failure = chosen->acquire();
    if (failure == 0)
        return chosen;
    (void)camera_fail(error, failure == -EBUSY ? "is used by another program; close that" : "can't be had: %s",
                      strerror(-failure));
    return nullptr;
}

namespace
{

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

struct choice_t {
    libcamera::Camera &camera;
    const camera_wanted_t &wanted;
    picture_t picture; /* without data */
    std::unique_ptr<libcamera::CameraConfiguration> configuration;
};

/* BT.601 or BT.709, of limited range; a pipeline that says nothing means V4L2's default, BT.601. */
bool judge_colours(choice_t &choice, char error[HAL_BOARD_ERROR_LENGTH])
{
    using libcamera::ColorSpace;
    const auto &space = choice.configuration->at(0).colorSpace;
    choice.picture.matrix =
        space && space->ycbcrEncoding == ColorSpace::YcbcrEncoding::Rec709 ? PICTURE_BT709 : PICTURE_BT601;
    if (!picture_is_yuv(choice.picture.format) || !space)
        return true;
    if (space->range == ColorSpace::Range::Limited && (space->ycbcrEncoding == ColorSpace::YcbcrEncoding::Rec709 ||
                                                       space->ycbcrEncoding == ColorSpace::YcbcrEncoding::Rec601))
        return true;
    return camera_fail(error, "gives colours %s, expected BT.601 or BT.709 of limited range; try another format",
                       space->toString().c_str());
}

bool try_format(choice_t &choice, const format_t &format, char error[HAL_BOARD_ERROR_LENGTH])
{
    const char *name = camera_format_name(format.format);
    const auto width = static_cast<unsigned>(choice.wanted.width), height = static_cast<unsigned>(choice.wanted.height);
    choice.configuration = choice.camera.generateConfiguration({libcamera::StreamRole::VideoRecording});
    if (!choice.configuration || choice.configuration->empty())
        return camera_fail(error, "has no video stream; choose another camera of `cam -l`");
    libcamera::StreamConfiguration &stream = choice.configuration->at(0);
    stream.pixelFormat = format.fourcc;
    stream.size = {width, height};
    stream.bufferCount = CAMERA_BUFFERS;
    if (picture_is_yuv(format.format))
        stream.colorSpace = libcamera::ColorSpace::Rec709;
    if (choice.configuration->validate() == libcamera::CameraConfiguration::Invalid)
        return camera_fail(error, "has no valid configuration for %s; see `cam -c 1 -I`", name);
    if (stream.pixelFormat != format.fourcc)
        return false; /* an earlier reason may tell more */
    if (stream.size.width != width || stream.size.height != height)
        return camera_fail(error, "gives %s of %ux%u at nearest, expected %ux%u as the room file states", name,
                           stream.size.width, stream.size.height, width, height);
    choice.picture = {};
    choice.picture.format = format.format;
    choice.picture.width = choice.wanted.width;
    choice.picture.height = choice.wanted.height;
    return judge_colours(choice, error);
}

} /* namespace */

std::unique_ptr<libcamera::CameraConfiguration> libcamera_configure(libcamera::Camera &camera,
                                                                    const camera_wanted_t &wanted, picture_t &picture,
                                                                    char error[HAL_BOARD_ERROR_LENGTH])
{
    (void)camera_fail(error, "gives none of the formats that are wanted; see `cam -c 1 -I` and README.md");
    choice_t choice = {camera, wanted, {}, nullptr};
    const camera_name_t &name = wanted.name;
    if (std::none_of(formats.begin(), formats.end(), [&](const format_t &format) {
            return (name.any_format || name.format == format.format) && try_format(choice, format, error);
        }))
        return nullptr;
    const int failure = camera.configure(choice.configuration.get());
    if (failure != 0) {
        (void)camera_fail(error, "can't be configured: %s; see LIBCAMERA_LOG_LEVELS=*:DEBUG", strerror(-failure));
        return nullptr;
    }
    const unsigned stride = choice.configuration->at(0).stride;
    choice.picture.stride[0] = choice.picture.stride[1] = stride > INT_MAX ? 0 : static_cast<int32_t>(stride);
    if (!picture_is_valid(&choice.picture)) {
        (void)camera_fail(error, "gives rows of %u bytes, which no picture has", stride);
        return nullptr;
    }
    picture = choice.picture;
    return std::move(choice.configuration);
}
