/* SPDX-License-Identifier: BSD-3-Clause
 * SHA-256 (FIPS 180-4) of a volume's voxels, through OpenSSL. */
#include <openssl/evp.h>
#include <string.h>

#include "metamer/volume.h"
#include "volume/voxel_type.h"

enum { CHUNK_BYTES = 1 << 16 };

/* Hashes in chunks, because on a big-endian machine each is turned round in a copy first. */
static bool hash_voxels(EVP_MD_CTX *context, const mtm_volume *volume) {
    const mtm_voxel_type type = mtm_volume_type(volume);
    const size_t voxel_bytes = mtm_voxel_type_bytes(type);
    const size_t byte_count = mtm_volume_voxel_count(volume) * voxel_bytes;
    const unsigned char *bytes = mtm_volume_voxels(volume);
    if (!mtm_is_big_endian()) return EVP_DigestUpdate(context, bytes, byte_count) == 1;
    bool is_good = true;
    for (size_t begin = 0; is_good && begin < byte_count; begin += CHUNK_BYTES) {
        unsigned char chunk[CHUNK_BYTES];
        const size_t count = byte_count - begin < CHUNK_BYTES ? byte_count - begin : CHUNK_BYTES;
        memcpy(chunk, bytes + begin, count);
        mtm_voxels_swap_bytes(type, chunk, count / voxel_bytes);
        is_good = EVP_DigestUpdate(context, chunk, count) == 1;
    }
    return is_good;
}

void mtm_volume_sha256(const mtm_volume *volume, char hex[65]) {
    static const char digits[] = "0123456789abcdef";
    unsigned char digest[32];
    EVP_MD_CTX *context = EVP_MD_CTX_new();
    const bool is_good = context != NULL && EVP_DigestInit_ex(context, EVP_sha256(), NULL) == 1 &&
                         hash_voxels(context, volume) && EVP_DigestFinal_ex(context, digest, NULL) == 1;
    EVP_MD_CTX_free(context);
    hex[is_good ? 64 : 0] = '\0';
    for (int i = 0; is_good && i < 32; i++) {
        hex[2 * i] = digits[digest[i] >> 4];
        hex[2 * i + 1] = digits[digest[i] & 15];
    }
}
