// SPDX-License-Identifier: Apache-2.0
// A USB camera on the virtual board's dummy_hcd, through gadgetfs: plugged in while this program runs.
//
// usage: usb_camera FOLDER        where gadgetfs is mounted
//
// It has one format, YUYV 320x180 at 30 Hz, and one picture: Y is the column, U and V the row. USB Video Class 1.1,
// with a bulk endpoint, as dummy_hcd fails all isochronous transfers, which the kernel's own video gadget (usb_f_uvc)
// needs. Section numbers are of "USB Device Class Definition for Video Devices" 1.1.
//
// It needs a real-time priority: gadgetfs loses what the host asks for while the data of an earlier request is not
// fetched. libcamera does not take this camera: it names those of USB after a firmware node above them, and dummy_hcd
// has none.
#include <errno.h>
#include <fcntl.h>
#include <linux/usb/ch9.h>
#include <linux/usb/gadgetfs.h>
#include <linux/usb/video.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 320, HEIGHT = 180, PICTURE_BYTES = WIDTH * HEIGHT * 2, HEADER_BYTES = 2, INTERVAL_US = 33333 };
enum { CONTROL = 0, STREAMING = 1, CAMERA_ID = 1, OUTPUT_ID = 2, ENDPOINT = USB_DIR_IN | 1, CLOCK_HZ = 48000000 };
enum { UVC_1_1 = 0x110, MOST_BYTES = 256 };

DECLARE_UVC_HEADER_DESCRIPTOR(1);
DECLARE_UVC_INPUT_HEADER_DESCRIPTOR(1, 1);
DECLARE_UVC_FRAME_UNCOMPRESSED(1);

/* As on the wire, 3.2 to 3.10. This machine's byte order is USB's. */
typedef struct __attribute__((packed)) {
    struct usb_config_descriptor configuration;
    struct usb_interface_assoc_descriptor function;
    struct usb_interface_descriptor control;
    struct UVC_HEADER_DESCRIPTOR(1) control_header;
    struct uvc_camera_terminal_descriptor camera;
    struct uvc_output_terminal_descriptor output;
    struct usb_interface_descriptor streaming;
    struct UVC_INPUT_HEADER_DESCRIPTOR(1, 1) streaming_header;
    struct uvc_format_uncompressed format;
    struct UVC_FRAME_UNCOMPRESSED(1) frame;
    struct uvc_color_matching_descriptor colours;
    struct usb_endpoint_descriptor endpoint; /* without its last two bytes, which are for audio */
} descriptors_t;

enum { DESCRIPTORS_BYTES = sizeof(descriptors_t) - sizeof(struct usb_endpoint_descriptor) + USB_DT_ENDPOINT_SIZE };

/* At high speed. */
static const descriptors_t descriptors = {
    .configuration = {USB_DT_CONFIG_SIZE, USB_DT_CONFIG, DESCRIPTORS_BYTES, .bNumInterfaces = 2,
                      .bConfigurationValue = 1, .bmAttributes = USB_CONFIG_ATT_ONE | USB_CONFIG_ATT_SELFPOWER},
    .function = {USB_DT_INTERFACE_ASSOCIATION_SIZE, USB_DT_INTERFACE_ASSOCIATION, CONTROL, 2, USB_CLASS_VIDEO,
                 UVC_SC_VIDEO_INTERFACE_COLLECTION},
    .control = {USB_DT_INTERFACE_SIZE, USB_DT_INTERFACE, CONTROL, 0, 0, USB_CLASS_VIDEO, UVC_SC_VIDEOCONTROL},
    .control_header = {sizeof descriptors.control_header,
                       USB_DT_CS_INTERFACE,
                       UVC_VC_HEADER,
                       UVC_1_1,
                       sizeof descriptors.control_header + sizeof descriptors.camera + sizeof descriptors.output,
                       CLOCK_HZ,
                       1,
                       {STREAMING}},
    .camera = {sizeof descriptors.camera, USB_DT_CS_INTERFACE, UVC_VC_INPUT_TERMINAL, CAMERA_ID, UVC_ITT_CAMERA,
               .bControlSize = 3},
    .output = {sizeof descriptors.output, USB_DT_CS_INTERFACE, UVC_VC_OUTPUT_TERMINAL, OUTPUT_ID, UVC_TT_STREAMING,
               .bSourceID = CAMERA_ID},
    .streaming = {USB_DT_INTERFACE_SIZE, USB_DT_INTERFACE, STREAMING, 0, 1, USB_CLASS_VIDEO, UVC_SC_VIDEOSTREAMING},
    .streaming_header = {sizeof descriptors.streaming_header, USB_DT_CS_INTERFACE, UVC_VS_INPUT_HEADER, 1,
                         sizeof descriptors.streaming_header + sizeof descriptors.format + sizeof descriptors.frame +
                             sizeof descriptors.colours,
                         ENDPOINT, .bTerminalLink = OUTPUT_ID, .bControlSize = 1},
    .format = {sizeof descriptors.format,
               USB_DT_CS_INTERFACE,
               UVC_VS_FORMAT_UNCOMPRESSED,
               1,
               1,
               {'Y', 'U', 'Y', '2', 0, 0, 0x10, 0, 0x80, 0, 0, 0xAA, 0, 0x38, 0x9B, 0x71},
               16,
               1},
    .frame = {sizeof descriptors.frame,
              USB_DT_CS_INTERFACE,
              UVC_VS_FRAME_UNCOMPRESSED,
              1,
              0,
              WIDTH,
              HEIGHT,
              PICTURE_BYTES * 240,
              PICTURE_BYTES * 240,
              PICTURE_BYTES,
              INTERVAL_US * 10,
              1,
              {INTERVAL_US * 10}},
    .colours = {sizeof descriptors.colours, USB_DT_CS_INTERFACE, UVC_VS_COLORFORMAT, 1, 1, 4 /* BT.601 */},
    .endpoint = {USB_DT_ENDPOINT_SIZE, USB_DT_ENDPOINT, ENDPOINT, USB_ENDPOINT_XFER_BULK, 512},
};
static const struct usb_device_descriptor about = {
    USB_DT_DEVICE_SIZE,     USB_DT_DEVICE, 0x200, USB_CLASS_MISC, 2, 1, 64, 0x1D6B, 0x0104, 0x0100,
    .bNumConfigurations = 1};

/* Answer to probe and commit, 4.3.1.1: a payload is a whole picture. */
static const struct uvc_streaming_control chosen = {
    .bFormatIndex = 1,
    .bFrameIndex = 1,
    .dwFrameInterval = INTERVAL_US * 10,
    .dwMaxVideoFrameSize = PICTURE_BYTES,
    .dwMaxPayloadTransferSize = HEADER_BYTES + PICTURE_BYTES,
    .dwClockFrequency = CLOCK_HZ,
};

static const char *folder;

static void fail(const char *what)
{
    fprintf(stderr, "usb_camera: %s: %s\n", what, strerror(errno));
    exit(1);
}

static int open_file(const char *name)
{
    char path[300];
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    const int file = open(path, O_RDWR | O_CLOEXEC);
    if (file < 0)
        fail(path);
    return file;
}

/* The last descriptor of those above, at full speed with 64 bytes. */
static void copy_endpoint(uint8_t *to, uint16_t packet_bytes)
{
    struct usb_endpoint_descriptor endpoint = descriptors.endpoint;
    endpoint.wMaxPacketSize = packet_bytes;
    memcpy(to, &endpoint, USB_DT_ENDPOINT_SIZE);
}

/* gadgetfs is told of an endpoint by a tag of 1, and its descriptors at both speeds. */
static void *stream(void *context)
{
    static uint8_t payload[HEADER_BYTES + PICTURE_BYTES] = {HEADER_BYTES};
    uint8_t setup[4 + 2 * USB_DT_ENDPOINT_SIZE] = {1};
    const int file = open_file("ep1in-bulk");
    (void)context;
    copy_endpoint(&setup[4], 64);
    copy_endpoint(&setup[4 + USB_DT_ENDPOINT_SIZE], 512);
    if (write(file, setup, sizeof setup) != sizeof setup)
        fail("endpoint");
    for (int i = 0; i < PICTURE_BYTES; i++)
        payload[HEADER_BYTES + i] = (uint8_t)(i % 2 == 0 ? i / 2 % WIDTH : i / 2 / WIDTH);
    for (int picture = 0;; picture ^= 1) {
        payload[1] = (uint8_t)(UVC_STREAM_EOH | UVC_STREAM_EOF | picture); /* UVC_STREAM_FID changes, 2.4.3.2.2 */
        (void)!write(file, payload, sizeof payload);                       /* the host need not take it */
        usleep(INTERVAL_US);
    }
    return NULL;
}

/* To use the wrong direction means that, and fails. */
static void stall(int file, const struct usb_ctrlrequest *request)
{
    const bool in = (request->bRequestType & USB_DIR_IN) != 0;
    (void)!(in ? read(file, NULL, 0) : write(file, NULL, 0));
}

/* Requests to the video streaming interface, 4.3; of others none is known. */
static bool answer_video(int file, const struct usb_ctrlrequest *request)
{
    static const uint8_t length[2] = {sizeof chosen}, info = 3; /* it can be got and set */
    uint8_t ignored[MOST_BYTES];
    if ((request->wIndex & 0xFF) != STREAMING)
        return false;
    if (request->bRequest == UVC_SET_CUR) {
        /* There is but one choice. It fails when the host has sent its next request by now, which is the next event. */
        (void)!read(file, ignored, sizeof ignored);
        return true;
    }
    if (request->bRequest == UVC_GET_INFO)
        return write(file, &info, 1) == 1;
    if (request->bRequest == UVC_GET_LEN)
        return write(file, length, sizeof length) == sizeof length;
    if (request->bRequest < UVC_GET_CUR || request->bRequest > UVC_GET_DEF)
        return false;
    const size_t bytes = request->wLength < sizeof chosen ? request->wLength : sizeof chosen;
    return write(file, &chosen, bytes) == (ssize_t)bytes;
}

static void answer(int file, const struct usb_ctrlrequest *request)
{
    static bool streaming;
    if ((request->bRequestType & USB_TYPE_MASK) == USB_TYPE_CLASS) {
        if (!answer_video(file, request))
            stall(file, request);
        return;
    }
    if (request->bRequest != USB_REQ_SET_CONFIGURATION && request->bRequest != USB_REQ_SET_INTERFACE) {
        stall(file, request);
        return;
    }
    pthread_t thread;
    if (request->bRequest == USB_REQ_SET_CONFIGURATION && request->wValue != 0 && !streaming)
        streaming = pthread_create(&thread, NULL, stream, NULL) == 0;
    if (read(file, NULL, 0) < 0)
        fail("acknowledge");
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    folder = argv[1];
    const int file = open_file("dummy_udc");
    /* A tag of 0, the configuration at full and at high speed, the device. */
    uint8_t setup[4 + 2 * DESCRIPTORS_BYTES + USB_DT_DEVICE_SIZE] = {0};
    memcpy(&setup[4], &descriptors, DESCRIPTORS_BYTES);
    copy_endpoint(&setup[4 + DESCRIPTORS_BYTES - USB_DT_ENDPOINT_SIZE], 64);
    memcpy(&setup[4 + DESCRIPTORS_BYTES], &descriptors, DESCRIPTORS_BYTES);
    memcpy(&setup[4 + 2 * DESCRIPTORS_BYTES], &about, USB_DT_DEVICE_SIZE);
    if (write(file, setup, sizeof setup) != sizeof setup)
        fail("descriptors");
    for (;;) {
        struct usb_gadgetfs_event event;
        if (read(file, &event, sizeof event) != sizeof event)
            fail("events");
        if (event.type == GADGETFS_SETUP)
            answer(file, &event.u.setup);
    }
}
