/* SPDX-License-Identifier: BSD-3-Clause
 * Renders the engine frames of `metamer bench` with VolPack, the shear-warp of P. Lacroute, M. Levoy, "Fast Volume
 * Rendering Using a Shear-Warp Factorization of the Viewing Transformation" (SIGGRAPH 1994), from a volume that is
 * classified and run-length encoded beforehand. It does less than a raycaster: parallel projection, voxels classified
 * before they are interpolated, one ray per voxel.
 * Usage: volpack_frames VOLUME.raw X Y Z smoke|solid EDGE, the picture EDGE x EDGE pixels. For each line of standard
 * input all views are rendered and a line is written: {"ms": [of every view], "fill": share of pixels not black}. */
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <volpack.h>

enum { VIEWS = 8, VALUES = 256, MATERIALS = 2, EDGE_MAX = 4096, SIDE_MAX = 2048, LINE_BYTES = 256 };
enum { NORMAL, VALUE, GRADIENT, FIELDS }; /* of a voxel; the classifier reads the last two */

typedef struct voxel {
    short normal;
    unsigned char value, gradient;
} voxel;

/* What VolPack keeps pointers to. */
typedef struct lookup_tables {
    float opacity_of_value[VALUES];
    float opacity_of_gradient[VP_GRAD_MAX + 1]; /* all 1 */
    float color[VP_NORM_MAX + 1][MATERIALS][3];
    float weight[VALUES][MATERIALS];
} lookup_tables;

typedef struct shear_warp {
    vpContext *context;
    int size[3], edge;
    unsigned char *values, *picture;
    voxel *voxels;
    lookup_tables *tables;
} shear_warp;

static double now_ms(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

/* Ends the program where VolPack could not do it. */
static void must(const shear_warp *peer, vpResult result, const char *what) {
    if (result == VP_OK) return;
    (void)fprintf(stderr, "volpack_frames: %s: %s\n", what, vpGetErrorString(vpGetError(peer->context)));
    exit(1);
}

static void *allocate(size_t count, size_t bytes) {
    void *memory = calloc(count, bytes);
    if (memory != NULL) return memory;
    (void)fprintf(stderr, "volpack_frames: out of memory\n");
    exit(1);
}

static float opacity_of(bool is_solid, double value) {
    static const double smoke[][2] = {{0, 0}, {80, 0}, {110, 0.02}, {180, 0.05}, {200, 0.6}, {255, 0.9}};
    static const double solid[][2] = {{0, 0}, {80, 0}, {110, 0.6}, {255, 0.95}};
    const double(*points)[2] = is_solid ? solid : smoke;
    while (value > points[1][0]) points++;
    const double share = (value - points[0][0]) / (points[1][0] - points[0][0]);
    return (float)(points[0][1] + share * (points[1][1] - points[0][1]));
}

static void fill_tables(bool is_solid, lookup_tables *tables) {
    for (int value = 0; value < VALUES; value++) {
        tables->opacity_of_value[value] = opacity_of(is_solid, value);
        tables->weight[value][1] = value <= 185 ? 0 : value >= 200 ? 1 : (float)(value - 185) / 15;
        tables->weight[value][0] = 1 - tables->weight[value][1];
    }
    for (int i = 0; i <= VP_GRAD_MAX; i++) tables->opacity_of_gradient[i] = 1;
}

/* Voxels with normals, then the run-length encoded volume. */
static void classify(const shear_warp *peer) {
    vpContext *context = peer->context;
    lookup_tables *tables = peer->tables;
    const int *size = peer->size;
    const size_t count = (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
    const int row_bytes = size[0] * (int)sizeof(voxel);
    must(peer, vpSetVolumeSize(context, size[0], size[1], size[2]), "size");
    must(peer, vpSetVoxelSize(context, sizeof(voxel), FIELDS, 2, 2), "voxel size");
    must(peer, vpSetVoxelField(context, NORMAL, sizeof(short), offsetof(voxel, normal), VP_NORM_MAX),
         "normal");
    must(peer, vpSetVoxelField(context, VALUE, 1, offsetof(voxel, value), VP_SCALAR_MAX), "value");
    must(peer, vpSetVoxelField(context, GRADIENT, 1, offsetof(voxel, gradient), VP_GRAD_MAX), "gradient");
    must(peer,
         vpSetRawVoxels(context, peer->voxels, (int)(count * sizeof(voxel)), sizeof(voxel), row_bytes,
                        row_bytes * size[1]),
         "voxels");
    must(peer, vpVolumeNormals(context, peer->values, (int)count, VALUE, GRADIENT, NORMAL), "normals");
    must(peer,
         vpSetClassifierTable(context, 0, VALUE, tables->opacity_of_value, sizeof tables->opacity_of_value),
         "opacity");
    must(peer,
         vpSetClassifierTable(context, 1, GRADIENT, tables->opacity_of_gradient,
                              sizeof tables->opacity_of_gradient),
         "opacity");
    must(peer, vpSetd(context, VP_MIN_VOXEL_OPACITY, 0.005), "least opacity");
    must(peer, vpSetd(context, VP_MAX_RAY_OPACITY, 0.99), "termination");
    must(peer, vpClassifyVolume(context), "classification");
}

static void set_material(const shear_warp *peer, int material, double red, double green, double blue) {
    vpContext *context = peer->context;
    must(peer,
         vpSetMaterial(context, material, VP_AMBIENT, VP_BOTH_SIDES, 0.3 * red, 0.3 * green, 0.3 * blue),
         "ambient");
    must(peer,
         vpSetMaterial(context, material, VP_DIFFUSE, VP_BOTH_SIDES, 0.6 * red, 0.6 * green, 0.6 * blue),
         "diffuse");
    must(peer, vpSetMaterial(context, material, VP_SPECULAR, VP_BOTH_SIDES, 0.3, 0.3, 0.3), "specular");
    must(peer, vpSetMaterial(context, material, VP_SHINYNESS, VP_BOTH_SIDES, 20, 0, 0), "shininess");
}

static void set_look(const shear_warp *peer) {
    vpContext *context = peer->context;
    lookup_tables *tables = peer->tables;
    must(peer,
         vpSetLookupShader(context, 3, MATERIALS, NORMAL, &tables->color[0][0][0], sizeof tables->color,
                           VALUE, &tables->weight[0][0], sizeof tables->weight),
         "shader");
    set_material(peer, VP_MATERIAL0, 0.6, 0.65, 0.8);
    set_material(peer, VP_MATERIAL1, 0.97, 0.7, 0.3);
    must(peer, vpSetLight(context, VP_LIGHT0, VP_DIRECTION, 0, 0, 1), "light");
    must(peer, vpSetLight(context, VP_LIGHT0, VP_COLOR, 1, 1, 1), "light");
    must(peer, vpEnable(context, VP_LIGHT0, 1), "light");
}

/* The frustum's width at the target, as in the perspective frames: ±1.75 tan 15° of the longest edge. */
static void set_projection(const shear_warp *peer) {
    vpContext *context = peer->context;
    const double half = 1.75 * 0.26794919243112270647;
    must(peer, vpSetImage(context, peer->picture, peer->edge, peer->edge, 3 * peer->edge, VP_RGB), "picture");
    must(peer, vpSeti(context, VP_CONCAT_MODE, VP_CONCAT_LEFT), "order of matrices");
    must(peer, vpCurrentMatrix(context, VP_PROJECT), "projection");
    must(peer, vpIdentityMatrix(context), "projection");
    must(peer, vpWindow(context, VP_PARALLEL, -half, half, -half, half, -2, 2), "projection");
    must(peer, vpCurrentMatrix(context, VP_MODEL), "view");
}

/* VolPack's volume is a unit cube round the origin. */
static void turn(const shear_warp *peer, int view) {
    vpContext *context = peer->context;
    const int *size = peer->size;
    const int wider = size[0] > size[1] ? size[0] : size[1];
    const double longest = wider > size[2] ? wider : size[2];
    must(peer, vpIdentityMatrix(context), "view");
    must(peer, vpScale(context, size[0] / longest, size[1] / longest, size[2] / longest), "view");
    must(peer, vpRotate(context, VP_Y_AXIS, -(15 + 360.0 * view / VIEWS)), "view");
    must(peer, vpRotate(context, VP_X_AXIS, 20), "view");
}

static double fill_of(const shear_warp *peer) {
    const size_t count = (size_t)peer->edge * (size_t)peer->edge;
    size_t filled = 0;
    for (size_t i = 0; i < count; i++) {
        const unsigned char *rgb = peer->picture + 3 * i;
        filled += (rgb[0] | rgb[1] | rgb[2]) != 0;
    }
    return (double)filled / (double)count;
}

/* The head light turns with the view, so its table is part of the frame. */
static void run_pass(const shear_warp *peer) {
    double fill = 0;
    (void)printf("{\"ms\": [");
    for (int view = 0; view < VIEWS; view++) {
        turn(peer, view);
        const double begin = now_ms();
        must(peer, vpShadeTable(peer->context), "shading");
        must(peer, vpRenderClassifiedVolume(peer->context), "rendering");
        (void)printf("%s%.4f", view == 0 ? "" : ", ", now_ms() - begin);
        fill += fill_of(peer) / VIEWS;
    }
    (void)printf("], \"fill\": %.5f}\n", fill);
    (void)fflush(stdout);
}

/* Sizes are checked before anything is allocated. */
static bool read_arguments(char **argv, shear_warp *peer) {
    peer->edge = atoi(argv[6]);
    bool is_good = peer->edge > 0 && peer->edge <= EDGE_MAX;
    for (int axis = 0; axis < 3; axis++) {
        peer->size[axis] = atoi(argv[2 + axis]);
        is_good = is_good && peer->size[axis] > 1 && peer->size[axis] <= SIDE_MAX;
    }
    return is_good && (strcmp(argv[5], "smoke") == 0 || strcmp(argv[5], "solid") == 0);
}

static void read_values(const char *path, size_t count, unsigned char *values) {
    FILE *stream = fopen(path, "rb");
    if (stream == NULL || fread(values, 1, count, stream) != count) {
        (void)fprintf(stderr, "volpack_frames: %s: cannot be read\n", path);
        exit(1);
    }
    (void)fclose(stream);
}

int main(int argc, char **argv) {
    char line[LINE_BYTES];
    shear_warp peer = {.context = NULL};
    if (argc != 7 || !read_arguments(argv, &peer)) {
        (void)fprintf(stderr, "usage: volpack_frames VOLUME.raw X Y Z smoke|solid EDGE\n");
        return 2;
    }
    const size_t count = (size_t)peer.size[0] * (size_t)peer.size[1] * (size_t)peer.size[2];
    peer.context = vpCreateContext();
    peer.values = allocate(count, 1);
    peer.voxels = allocate(count, sizeof *peer.voxels);
    peer.picture = allocate((size_t)peer.edge * (size_t)peer.edge, 3);
    peer.tables = allocate(1, sizeof *peer.tables);
    read_values(argv[1], count, peer.values);
    fill_tables(strcmp(argv[5], "solid") == 0, peer.tables);
    classify(&peer);
    set_look(&peer);
    set_projection(&peer);
    while (fgets(line, sizeof line, stdin) != NULL) run_pass(&peer);
    vpDestroyContext(peer.context);
    free(peer.values);
    free(peer.voxels);
    free(peer.picture);
    free(peer.tables);
    return 0;
}
