// SPDX-License-Identifier: Apache-2.0
// Pictures in DMABUFs: see the header.
#include "hal/linux/camera_dmabuf.h"

#include <errno.h>
#include <linux/dma-buf.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

/* Of a picture whose chroma is in the same piece. */
static size_t chroma_offset(const picture_t *picture)
{
    return (size_t)picture->stride[0] * (size_t)picture->height;
}

static bool holds(const camera_dmabuf_t *pieces, size_t count, const picture_t *picture)
{
    const size_t luma = chroma_offset(picture);
    const size_t chroma =
        picture->format == PICTURE_NV12 ? (size_t)picture->stride[1] * (size_t)picture->height / 2 : 0;
    if (count == 2)
        return chroma != 0 && pieces[0].length >= luma && pieces[1].length >= chroma;
    return count == 1 && pieces[0].length >= luma + chroma;
}

bool camera_dmabuf_map(camera_exchange_t *exchange, int buffer, const camera_dmabuf_t *pieces, size_t count,
                       const picture_t *picture, char error[HAL_BOARD_ERROR_LENGTH])
{
    if (!holds(pieces, count, picture))
        return camera_fail(error, "has buffers that the picture does not fit into");
    camera_map_t map[PICTURE_MAX_PLANES] = {{NULL, 0}};
    for (size_t i = 0; i < count; i++) {
        const size_t length = pieces[i].offset + pieces[i].length; /* maps begin at a page */
        void *address = mmap(NULL, length, PROT_READ, MAP_SHARED, pieces[i].file, 0);
        if (address == MAP_FAILED) {
            (void)camera_fail(error, "can't map %zu bytes of buffer %d: %s", length, buffer, strerror(errno));
            if (i == 1)
                (void)munmap(map[0].address, map[0].length);
            return false;
        }
        map[i] = (camera_map_t){address, length};
    }
    camera_exchange_map(exchange, buffer, map);
    return true;
}

void camera_dmabuf_place(picture_t *picture, const camera_exchange_t *exchange, int buffer,
                         const camera_dmabuf_t *pieces, size_t count)
{
    for (size_t i = 0; i < count; i++)
        picture->data[i] = (uint8_t *)camera_exchange_memory(exchange, buffer, (int)i).address + pieces[i].offset;
    if (picture->format == PICTURE_NV12 && count == 1)
        picture->data[1] = picture->data[0] + chroma_offset(picture);
}

/* Memory that needs none of it refuses. */
void camera_dmabuf_begin_read(int file)
{
    const struct dma_buf_sync sync = {DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ};
    (void)ioctl(file, DMA_BUF_IOCTL_SYNC, &sync);
}

void camera_dmabuf_end_read(int file)
{
    const struct dma_buf_sync sync = {DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ};
    (void)ioctl(file, DMA_BUF_IOCTL_SYNC, &sync);
}
