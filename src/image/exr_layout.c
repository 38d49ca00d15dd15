/* SPDX-License-Identifier: BSD-3-Clause
 * What the names of an OpenEXR file's channels say about its content.
 * The pattern of wavelengths follows A. Fichet, R. Pacanowski, A. Wilkie, "An OpenEXR Layout for Spectral
 * Images", Journal of Computer Graphics Techniques 10(3), 2021: a decimal comma, because a dot separates
 * layers. */
#include "image/exr_layout.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "base/memory.h"
#include "base/number.h"

enum {
    NUMBER_BYTES = 48,
    WAVELENGTHS_MAX = 4096,
};

/* Powers of ten of the SI prefixes, one character each. */
static const struct {
    char prefix;
    int exponent;
} si_prefixes[] = {
    {'Y', 24}, {'Z', 21}, {'E', 18}, {'P', 15}, {'T', 12}, {'G', 9},  {'M', 6},   {'k', 3},
    {'h', 2},  {'d', -1}, {'c', -2}, {'m', -3}, {'u', -6}, {'n', -9}, {'p', -12},
};

/* Length of digits, a decimal comma and an exponent at the start of `text`. An E without digits after it
 * belongs to the unit: it is the prefix exa. */
static size_t number_length(const char *text) {
    const char *end = text;
    while (isdigit((unsigned char)*end) || *end == ',') end++;
    const char *exponent = end;
    if (*exponent == 'e' || *exponent == 'E') exponent++;
    if (exponent > end && (*exponent == '+' || *exponent == '-')) exponent++;
    if (exponent > end && isdigit((unsigned char)*exponent)) {
        end = exponent;
        while (isdigit((unsigned char)*end)) end++;
    }
    return (size_t)(end - text);
}

/* The number at the start of `text`, with its comma read as a decimal mark; the rest of the text, or NULL. */
static const char *scan_number(const char *text, double *number) {
    char copy[NUMBER_BYTES];
    const size_t length = number_length(text);
    if (length == 0 || length >= sizeof copy) return NULL;
    memcpy(copy, text, length);
    copy[length] = '\0';
    char *comma = strchr(copy, ',');
    if (comma != NULL) *comma = '.';
    return mtm_number_parse(copy, number) ? text + length : NULL;
}

/* A unit with its prefix at the start of `text`: the wavelength in nm of `number` of it. */
static const char *scan_unit(const char *text, double number, double *wavelength_nm) {
    int exponent = 0;
    const bool is_metre_alone = text[0] == 'm' && (text[1] == '\0' || text[1] == '.');
    for (size_t i = 0; i < sizeof si_prefixes / sizeof *si_prefixes && !is_metre_alone; i++) {
        if (text[0] != si_prefixes[i].prefix) continue;
        exponent = si_prefixes[i].exponent;
        text++;
        break;
    }
    if (strncmp(text, "Hz", 2) == 0) {
        *wavelength_nm = 299792458.0 * pow(10.0, 9 - exponent) / number; /* λ = c / ν */
        return text + 2;
    }
    if (text[0] != 'm') return NULL;
    *wavelength_nm = number * pow(10.0, 9 + exponent);
    return text + 1;
}

static const char *scan_wavelength(const char *text, double *wavelength_nm) {
    double number = 0.0;
    const char *rest = scan_number(text, &number);
    if (rest != NULL) rest = scan_unit(rest, number, wavelength_nm);
    const bool is_usable = rest != NULL && isfinite(*wavelength_nm) && *wavelength_nm > 0.0;
    return is_usable ? rest : NULL;
}

mtm_exr_meaning mtm_exr_channel_meaning(const char *name, double *wavelength_nm) {
    const bool is_reflective = strncmp(name, "T.", 2) == 0;
    const bool is_emissive = name[0] == 'S' && name[1] >= '0' && name[1] <= '3' && name[2] == '.';
    if (!is_reflective && !is_emissive) return MTM_EXR_OTHER;
    const char *rest = scan_wavelength(name + (is_reflective ? 2 : 3), wavelength_nm);
    if (rest == NULL) return MTM_EXR_OTHER;
    if (*rest == '\0') return is_reflective ? MTM_EXR_REFLECTIVE : MTM_EXR_EMISSIVE;
    double second_nm = 0.0;
    const bool is_fluorescent =
        is_reflective && *rest == '.' && scan_wavelength(rest + 1, &second_nm) != NULL;
    return is_fluorescent ? MTM_EXR_FLUORESCENT : MTM_EXR_OTHER;
}

/* The number of "C.dd", or -1. */
static int coefficient_of(const char *name) {
    if (strncmp(name, "C.", 2) != 0 || !isdigit((unsigned char)name[2]) || !isdigit((unsigned char)name[3]))
        return -1;
    return name[4] == '\0' ? (name[2] - '0') * 10 + (name[3] - '0') : -1;
}

static int count_meaning(const exr_attr_chlist_t *channels, mtm_exr_meaning meaning) {
    int count = 0;
    double wavelength_nm = 0.0;
    for (int i = 0; i < channels->num_channels; i++)
        count += mtm_exr_channel_meaning(channels->entries[i].name.str, &wavelength_nm) == meaning;
    return count;
}

static int count_coefficients(const exr_attr_chlist_t *channels) {
    int count = 0;
    for (int i = 0; i < channels->num_channels; i++)
        count += coefficient_of(channels->entries[i].name.str) >= 0;
    return count;
}

/* Names are unique and sorted in a file, but a broken file is not held to that: each slot is filled once. */
static mtm_status find_coefficients(const exr_attr_chlist_t *channels, const char *path,
                                    mtm_exr_layout *layout, mtm_error *error) {
    bool is_filled[100] = {false};
    layout->slot_count = count_coefficients(channels);
    if (layout->slot_count > MTM_DIMENSION_MAX)
        return mtm_fail(error, MTM_LIMIT, "%s: %d coefficient channels C.00 …, at most %d are supported",
                        path, layout->slot_count, MTM_DIMENSION_MAX);
    for (int i = 0; i < channels->num_channels; i++) {
        const char *name = channels->entries[i].name.str;
        const int coefficient = coefficient_of(name);
        if (coefficient < 0) continue;
        if (coefficient >= layout->slot_count || is_filled[coefficient])
            return mtm_fail(
                error, MTM_FORMAT,
                "%s: channel '%s' does not fit %d coefficient channels, which must be numbered from "
                "C.00 without a gap",
                path, name, layout->slot_count);
        is_filled[coefficient] = true;
        layout->slot[i] = coefficient;
    }
    return MTM_OK;
}

typedef struct spectral_channel {
    double wavelength_nm;
    int channel;
} spectral_channel;

static int compare_wavelengths(const void *a, const void *b) {
    const spectral_channel *left = a;
    const spectral_channel *right = b;
    return (left->wavelength_nm > right->wavelength_nm) - (left->wavelength_nm < right->wavelength_nm);
}

/* Gives the sorted wavelengths their slots. OpenEXR sorts channels as texts, so the order of the file is
 * none. */
static mtm_status place_wavelengths(const exr_attr_chlist_t *channels, spectral_channel *found,
                                    const char *path, mtm_exr_layout *layout, mtm_error *error) {
    int count = 0;
    for (int i = 0; i < channels->num_channels; i++) {
        double nm = 0.0;
        if (mtm_exr_channel_meaning(channels->entries[i].name.str, &nm) == MTM_EXR_REFLECTIVE)
            found[count++] = (spectral_channel){.wavelength_nm = nm, .channel = i};
    }
    qsort(found, (size_t)count, sizeof *found, compare_wavelengths);
    for (int i = 0; i < count; i++) {
        if (i > 0 && !(found[i].wavelength_nm > found[i - 1].wavelength_nm))
            return mtm_fail(error, MTM_FORMAT,
                            "%s: channels '%s' and '%s' have the same wavelength; each may appear once", path,
                            channels->entries[found[i - 1].channel].name.str,
                            channels->entries[found[i].channel].name.str);
        layout->slot[found[i].channel] = i;
        layout->wavelength_nm[i] = found[i].wavelength_nm;
    }
    return MTM_OK;
}

static mtm_status find_reflectances(const exr_attr_chlist_t *channels, const char *path,
                                    mtm_exr_layout *layout, mtm_error *error) {
    if (count_meaning(channels, MTM_EXR_FLUORESCENT) > 0)
        return mtm_fail(error, MTM_FORMAT,
                        "%s: holds fluorescence (channels T.<wavelength>.<wavelength>), expected plain "
                        "reflectances T.<wavelength>",
                        path);
    layout->slot_count = count_meaning(channels, MTM_EXR_REFLECTIVE);
    if (layout->slot_count > WAVELENGTHS_MAX)
        return mtm_fail(error, MTM_LIMIT, "%s: %d wavelengths, at most %d are supported", path,
                        layout->slot_count, WAVELENGTHS_MAX);
    const size_t count = (size_t)layout->slot_count;
    spectral_channel *found = mtm_allocate(count, sizeof *found);
    layout->wavelength_nm = mtm_allocate(count, sizeof *layout->wavelength_nm);
    const mtm_status status = found != NULL && layout->wavelength_nm != NULL
                                  ? place_wavelengths(channels, found, path, layout, error)
                                  : mtm_fail_memory(error, path, count * sizeof *found);
    free(found);
    return status;
}

static mtm_status find_nothing(const exr_attr_chlist_t *channels, const char *path, mtm_error *error) {
    if (count_meaning(channels, MTM_EXR_EMISSIVE) > 0)
        return mtm_fail(
            error, MTM_FORMAT,
            "%s: holds radiance (channels S0.<wavelength>), which is already lit and cannot be relit; "
            "expected coefficients C.00 … or reflectances T.<wavelength>",
            path);
    return mtm_fail(
        error, MTM_FORMAT,
        "%s: has no coefficients (channels C.00 …) and no reflectances (T.<wavelength>), so it cannot "
        "be relit; its first channel is '%s'",
        path, channels->num_channels > 0 ? channels->entries[0].name.str : "");
}

static void find_alpha(const exr_attr_chlist_t *channels, mtm_exr_layout *layout) {
    for (int i = 0; i < channels->num_channels; i++) {
        if (strcmp(channels->entries[i].name.str, "A") != 0) continue;
        layout->slot[i] = layout->slot_count;
        layout->has_alpha = true;
    }
}

/* OpenEXR allows integers, and channels with fewer samples than pixels, which would also move the others. */
static mtm_status check_channels(const exr_attr_chlist_t *channels, const char *path,
                                 const mtm_exr_layout *layout, mtm_error *error) {
    for (int i = 0; i < channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *channel = &channels->entries[i];
        if (channel->x_sampling != 1 || channel->y_sampling != 1)
            return mtm_fail(error, MTM_FORMAT, "%s: channel '%s' has sampling %d x %d, expected 1 x 1", path,
                            channel->name.str, channel->x_sampling, channel->y_sampling);
        if (layout->slot[i] < 0) continue;
        if (channel->pixel_type != EXR_PIXEL_HALF && channel->pixel_type != EXR_PIXEL_FLOAT)
            return mtm_fail(error, MTM_FORMAT, "%s: channel '%s' has pixel type %d, expected half or float",
                            path, channel->name.str, (int)channel->pixel_type);
    }
    return MTM_OK;
}

mtm_status mtm_exr_layout_find(const exr_attr_chlist_t *channels, const char *path, mtm_exr_layout *layout,
                               mtm_error *error) {
    const size_t count = (size_t)channels->num_channels;
    *layout = (mtm_exr_layout){.channel_count = channels->num_channels};
    layout->slot = mtm_allocate(count, sizeof *layout->slot);
    if (layout->slot == NULL) return mtm_fail_memory(error, path, count * sizeof *layout->slot);
    for (size_t i = 0; i < count; i++) layout->slot[i] = -1;
    mtm_status status = MTM_OK;
    if (count_coefficients(channels) > 0)
        status = find_coefficients(channels, path, layout, error);
    else if (count_meaning(channels, MTM_EXR_REFLECTIVE) > 0)
        status = find_reflectances(channels, path, layout, error);
    else
        status = find_nothing(channels, path, error);
    if (status != MTM_OK) return status;
    find_alpha(channels, layout);
    return check_channels(channels, path, layout, error);
}

void mtm_exr_layout_free(mtm_exr_layout *layout) {
    free(layout->slot);
    free(layout->wavelength_nm);
    *layout = (mtm_exr_layout){0};
}
