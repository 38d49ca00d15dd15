/* SPDX-License-Identifier: BSD-3-Clause
 * Tabulating the transfer function.
 * Max, "Optical models for direct volume rendering", TVCG 1(2), 1995 (emission and absorption); paper eq. 5. */
#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/fail.h"
#include "base/memory.h"
#include "transfer/table.h"

/* -ln(1 - α) is linear between nodes to Δα²/8, 8e-9 of an optical depth at this density. */
enum { NODES_PER_OPACITY = 4096 };
static const double opacity_cap = 0.9999;

static double optical_depth(double opacity) {
    return -log1p(-fmin(opacity, opacity_cap));
}

/* Optical depth that a point scatters over one opacity length. */
static double point_emission(const mtm_transfer_point *point) {
    return point->has_emission ? point->emission : optical_depth(point->opacity);
}

static int nodes_between(const mtm_transfer_point *a, const mtm_transfer_point *b) {
    if (!(b->value > a->value)) return 1;
    const double change = fabs(fmin(b->opacity, opacity_cap) - fmin(a->opacity, opacity_cap));
    return 1 + (int)ceil(change * NODES_PER_OPACITY);
}

static double mix(double a, double b, double fraction) {
    return a + fraction * (b - a);
}

/* The node at `fraction` of the way between two points. */
static mtm_transfer_node make_node(const mtm_transfer *transfer, const mtm_transfer_point *a,
                                   const mtm_transfer_point *b, double fraction, int segment) {
    const double opacity = mix(fmin(a->opacity, opacity_cap), fmin(b->opacity, opacity_cap), fraction);
    const bool is_following = !a->has_emission && !b->has_emission;
    const double depth = optical_depth(opacity);
    const double emitted = is_following ? depth : mix(point_emission(a), point_emission(b), fraction);
    return (mtm_transfer_node){
        .position = mtm_transfer_position(transfer, mix(a->value, b->value, fraction)),
        .extinction = (float)(depth / transfer->opacity_length),
        .emission = (float)(emitted / transfer->opacity_length),
        .segment = segment,
    };
}

static mtm_transfer_segment make_segment(const mtm_transfer *transfer, const mtm_transfer_point *a,
                                         const mtm_transfer_point *b) {
    const float begin = mtm_transfer_position(transfer, a->value);
    const float end = mtm_transfer_position(transfer, b->value);
    return (mtm_transfer_segment){
        .begin = begin,
        .inverse_length = end > begin ? 1.0f / (end - begin) : 0.0f,
        .first = transfer->encodings + (size_t)a->material * (size_t)transfer->lanes,
        .last = transfer->encodings + (size_t)b->material * (size_t)transfer->lanes,
    };
}

/* Segment 0 holds the first point from -1 on, segment k runs from point k-1 to point k, the last one holds. */
static void fill_nodes(mtm_transfer *transfer, int point_count, const mtm_transfer_point *points) {
    const mtm_transfer_point *last = &points[point_count - 1];
    int count = 0;
    transfer->segments[0] = make_segment(transfer, &points[0], &points[0]);
    transfer->nodes[count] = make_node(transfer, &points[0], &points[0], 0, 0);
    transfer->nodes[count++].position = -1;
    for (int k = 0; k + 1 < point_count; k++) {
        const int parts = nodes_between(&points[k], &points[k + 1]);
        transfer->segments[k + 1] = make_segment(transfer, &points[k], &points[k + 1]);
        for (int i = 0; i < parts; i++)
            transfer->nodes[count++] =
                make_node(transfer, &points[k], &points[k + 1], (double)i / parts, k + 1);
    }
    transfer->segments[point_count] = make_segment(transfer, last, last);
    transfer->nodes[count++] = make_node(transfer, last, last, 0, point_count);
    transfer->nodes[count] = transfer->nodes[count - 1];
    transfer->nodes[count++].position = 2;
    assert(count == transfer->node_count);
}

static bool is_visible(const mtm_transfer_node *node) {
    return node->extinction > 0 || node->emission > 0;
}

static void fill_lookups(mtm_transfer *transfer) {
    int node = 0;
    for (int cell = 0; cell <= MTM_LOOKUP_CELLS; cell++) {
        const float begin = (float)cell / MTM_LOOKUP_CELLS_PER_UNIT - 1.0f;
        while (node + 2 < transfer->node_count && transfer->nodes[node + 1].position < begin) node++;
        transfer->lookup[cell] = node;
    }
    for (int i = 0; i + 1 < transfer->node_count; i++)
        transfer->visible_before[i + 1] = transfer->visible_before[i] + (is_visible(&transfer->nodes[i]) ||
                                                                         is_visible(&transfer->nodes[i + 1]));
}

static void fill_encodings(mtm_transfer *transfer, const mtm_basis *basis) {
    const int material_count = mtm_basis_material_count(basis);
    for (int i = 0; i < material_count; i++)
        mtm_basis_encode_material(basis, i, transfer->encodings + (size_t)i * (size_t)transfer->lanes);
    float *white = transfer->encodings + (size_t)material_count * (size_t)transfer->lanes;
    mtm_basis_encode_white(basis, white);
    transfer->white = white;
}

static mtm_status allocate(mtm_transfer *transfer, int material_count, mtm_error *error) {
    const size_t nodes = (size_t)transfer->node_count;
    transfer->nodes = mtm_allocate(nodes, sizeof *transfer->nodes);
    transfer->segments = mtm_allocate((size_t)transfer->segment_count, sizeof *transfer->segments);
    transfer->lookup = mtm_allocate(MTM_LOOKUP_CELLS + 1, sizeof *transfer->lookup);
    transfer->visible_before = mtm_allocate(nodes, sizeof *transfer->visible_before);
    transfer->encodings =
        mtm_allocate(((size_t)material_count + 1) * (size_t)transfer->lanes, sizeof *transfer->encodings);
    if (transfer->nodes == NULL || transfer->segments == NULL || transfer->lookup == NULL ||
        transfer->visible_before == NULL || transfer->encodings == NULL)
        return mtm_fail_memory(error, "the transfer function", nodes * sizeof *transfer->nodes);
    return MTM_OK;
}

static int count_nodes(int point_count, const mtm_transfer_point *points) {
    int count = 3; /* the two holding ends and the last point */
    for (int k = 0; k + 1 < point_count; k++) count += nodes_between(&points[k], &points[k + 1]);
    return count;
}

mtm_status mtm_transfer_create(int point_count, const mtm_transfer_point *points, double opacity_length,
                               const mtm_basis *basis, mtm_transfer **transfer, mtm_error *error) {
    assert(point_count >= 1 && opacity_length > 0);
    mtm_transfer *made = mtm_allocate(1, sizeof *made);
    if (made == NULL) return mtm_fail_memory(error, "the transfer function", sizeof *made);
    const double width = points[point_count - 1].value - points[0].value;
    made->origin = points[0].value;
    made->scale = width > 0 && isfinite(1 / width) ? 1 / width : 1;
    made->opacity_length = opacity_length;
    made->node_count = count_nodes(point_count, points);
    made->segment_count = point_count + 1;
    made->dimension = mtm_basis_dimension(basis);
    made->lanes = mtm_lanes(made->dimension);
    const mtm_status status = allocate(made, mtm_basis_material_count(basis), error);
    if (status != MTM_OK) {
        mtm_transfer_destroy(made);
        return status;
    }
    fill_encodings(made, basis);
    fill_nodes(made, point_count, points);
    fill_lookups(made);
    *transfer = made;
    return MTM_OK;
}

void mtm_transfer_destroy(mtm_transfer *transfer) {
    if (transfer == NULL) return;
    free(transfer->nodes);
    free(transfer->segments);
    free(transfer->lookup);
    free(transfer->visible_before);
    free(transfer->encodings);
    free(transfer);
}

mtm_classified mtm_transfer_classify(const mtm_transfer *transfer, double value, float *coefficients) {
    const float position = mtm_transfer_clamp(mtm_transfer_position(transfer, value));
    const mtm_transfer_row row = mtm_transfer_look_up(transfer, position);
    for (int i = 0; coefficients != NULL && i < transfer->dimension; i++)
        coefficients[i] = row.segment->first[i] + row.share * (row.segment->last[i] - row.segment->first[i]);
    return (mtm_classified){row.extinction, row.emission};
}

bool mtm_transfer_is_visible(const mtm_transfer *transfer, double low, double high) {
    return mtm_transfer_sees(transfer, mtm_transfer_clamp(mtm_transfer_position(transfer, low)),
                             mtm_transfer_clamp(mtm_transfer_position(transfer, high)));
}
