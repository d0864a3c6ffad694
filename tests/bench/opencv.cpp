// SPDX-License-Identifier: Apache-2.0
// What the benchmark asks of OpenCV, as C: Debian's OpenCV 4 has no header that a C compiler reads.
#include "tests/bench/opencv.h"

#include <opencv2/imgproc.hpp>

/* A view: neither copies nor owns the pixels. */
static cv::Mat mat_of(const image_t *image)
{
    return cv::Mat(image->height, image->width, CV_8UC(static_cast<int>(image->format)), image->data,
                   static_cast<size_t>(image->stride));
}

const char *opencv_version(void)
{
    return CV_VERSION;
}

void opencv_set_threads(int threads)
{
    cv::setNumThreads(threads);
}

void opencv_warp_perspective(opencv_work_t interpolation, const double rows[3][3], const image_t *panel,
                             const image_t *picture)
{
    const int flags = interpolation == OPENCV_NEAREST  ? cv::INTER_NEAREST
                      : interpolation == OPENCV_LINEAR ? cv::INTER_LINEAR
                                                       : cv::INTER_CUBIC;
    cv::Matx33d map;
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            map(r, k) = rows[r][k];
    cv::Mat out = mat_of(panel);
    cv::warpPerspective(mat_of(picture), out, map, out.size(), flags | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT);
}

void opencv_gaussian_blur(double sigma, const image_t *blurred, const image_t *picture)
{
    cv::Mat out = mat_of(blurred);
    cv::GaussianBlur(mat_of(picture), out, cv::Size(7, 7), sigma, sigma, cv::BORDER_REFLECT);
}
