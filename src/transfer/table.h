/* SPDX-License-Identifier: BSD-3-Clause
 * The tabulated transfer function as the renderers' inner loops read it.
 *
 * The table runs over positions: (value - origin) · scale, 0 at the first point's value and 1 at the last one's.
 * Nodes stand exactly on every point, so points, kinks and jumps are met exactly, and close enough between them for
 * τ(opacity) to be linear from node to node. Outside 0 … 1 the end points are held up to -1 and 2. */
#ifndef METAMER_TRANSFER_TABLE_H
#define METAMER_TRANSFER_TABLE_H

#include "metamer/transfer.h"

typedef struct mtm_transfer_node {
    float position;
    float extinction, emission; /* per world unit */
    int segment;                /* of the cell that begins here */
} mtm_transfer_node;

/* Between two points the mix goes linearly from one material to the other. */
typedef struct mtm_transfer_segment {
    float begin, inverse_length; /* in positions */
    const float *first, *last;   /* encodings, `lanes` floats each */
} mtm_transfer_segment;

struct mtm_transfer {
    double origin, scale;
    double opacity_length; /* world units */
    int node_count;
    mtm_transfer_node *nodes;
    int segment_count;
    mtm_transfer_segment *segments;
    /* For MTM_LOOKUP_CELLS equal cells of -1 … 2 and the end: the last node strictly before the cell's begin, so that a
     * search from there passes every node of a jump that stands on it. */
    int *lookup;
    int *visible_before; /* number of visible cells before cell i; node_count entries */
    int dimension, lanes;
    float *encodings; /* (materials and white) × lanes, zeros behind the d coefficients */
    const float *white;
};

enum { MTM_LOOKUP_CELLS_PER_UNIT = 2048, MTM_LOOKUP_CELLS = 3 * MTM_LOOKUP_CELLS_PER_UNIT };

/* Position of a physical value; the same arithmetic for points and for voxels, so that equal values meet. */
static inline float mtm_transfer_position(const struct mtm_transfer *transfer, double value) {
    return (float)((value - transfer->origin) * transfer->scale);
}

static inline float mtm_transfer_clamp(float position) {
    return position > -1.0f ? (position < 2.0f ? position : 2.0f) : -1.0f;
}

/* The cell (index of its first node) that holds a clamped position. */
static inline int mtm_transfer_cell(const struct mtm_transfer *transfer, float position) {
    int cell = transfer->lookup[(int)((position + 1.0f) * MTM_LOOKUP_CELLS_PER_UNIT)];
    while (cell + 2 < transfer->node_count && transfer->nodes[cell + 1].position <= position) cell++;
    return cell;
}

/* How far into a cell a position is, 0 … 1. */
static inline float mtm_transfer_fraction(const mtm_transfer_node *node, float position) {
    const float width = node[1].position - node[0].position;
    return width > 0 ? (position - node[0].position) / width : 1.0f;
}

/* What the table holds at a clamped position. */
typedef struct mtm_transfer_row {
    float extinction, emission;          /* per world unit */
    const mtm_transfer_segment *segment; /* the mix: from segment->first … */
    float share;                         /* … this far to segment->last */
} mtm_transfer_row;

static inline mtm_transfer_row mtm_transfer_look_up(const struct mtm_transfer *transfer, float position) {
    const mtm_transfer_node *node = &transfer->nodes[mtm_transfer_cell(transfer, position)];
    const mtm_transfer_segment *segment = &transfer->segments[node->segment];
    const float fraction = mtm_transfer_fraction(node, position);
    return (mtm_transfer_row){
        .extinction = node[0].extinction + fraction * (node[1].extinction - node[0].extinction),
        .emission = node[0].emission + fraction * (node[1].emission - node[0].emission),
        .segment = segment,
        .share = (position - segment->begin) * segment->inverse_length,
    };
}

/* Whether any of the cells between two clamped positions is visible. */
static inline bool mtm_transfer_sees(const struct mtm_transfer *transfer, float low, float high) {
    const int first = mtm_transfer_cell(transfer, low);
    const int last = mtm_transfer_cell(transfer, high);
    return transfer->visible_before[last + 1] > transfer->visible_before[first];
}

#endif
