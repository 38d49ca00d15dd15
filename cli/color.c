/* SPDX-License-Identifier: BSD-3-Clause
 * metamer color: the colors of reflectances under a light, by full spectra (CIE 015:2018) or from the coefficients of a
 * basis, so that the difference of both is the error of the basis. Sums over the grid; docs/files.md has the form. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "document.h"
#include "task.h"

static const command_option options[] = {
    {"--illuminant", "NAME|FILE.csv:COLUMN", "the light: D65 (default), FL11, a measured one"},
    {"--observer", "NAME|FILE.csv", "cie1931 (default); a table of x, y, z, or a camera's R, G, B"},
    {"--basis", "NAME", "compute from coefficients: factors:7, sharpened:5, wavelengths, …"},
    {"--through", "A,B", "filters the light passes: columns, or FILE.csv:COLUMN; repeatable"},
    {"--json", NULL, "print a JSON document"},
    {NULL, NULL, NULL},
};

enum { THROUGH_MAX = 64 };

typedef struct color_request {
    const char *input, *illuminant, *observer, *basis;
    const char *through[THROUGH_MAX];
    int through_count;
    bool is_json;
} color_request;

/* All that stands between a reflectance and its color. */
typedef struct viewing {
    mtm_observer observer;
    mtm_spectrum light;  /* what shines on the samples: its filters passed, y (a camera's green) 1 on white */
    mtm_spectrum source; /* the same before the filters, on the same scale */
    mtm_xyz white;
    double srgb_from_xyz[3][3];           /* linear, the white adapted to D65 */
    double picture_from_xyz[3][3];        /* linear, as pictures show it */
    json_t *filters;                      /* their names */
    mtm_basis *basis;                     /* NULL: full spectra */
    double filter[MTM_DIMENSION_MAX];     /* coefficients of the filters' product */
    double matrix[3 * MTM_DIMENSION_MAX]; /* from coefficients to XYZ under the source */
} viewing;

static mtm_status fail_memory(const char *path, mtm_error *error) {
    (void)snprintf(error->message, sizeof error->message, "%s: out of memory for its colors", path);
    return MTM_MEMORY;
}

static mtm_rgb apply(const double m[3][3], mtm_xyz xyz) {
    return (mtm_rgb){m[0][0] * xyz.x + m[0][1] * xyz.y + m[0][2] * xyz.z,
                     m[1][0] * xyz.x + m[1][1] * xyz.y + m[1][2] * xyz.z,
                     m[2][0] * xyz.x + m[2][1] * xyz.y + m[2][2] * xyz.z};
}

/* A basis whose coefficients multiply encodes any spectrum, too; another one says here what it lacks. */
static mtm_status open_basis(const viewing *v, const char *name, mtm_basis **basis, mtm_error *error) {
    const double ones[MTM_DIMENSION_MAX] = {1};
    double product[MTM_DIMENSION_MAX];
    const mtm_illumination illumination = mtm_illumination_of(&v->source, &v->observer, 0);
    const mtm_status status = mtm_basis_create(name, 0, NULL, &illumination, basis, error);
    return status == MTM_OK ? mtm_basis_multiply(*basis, ones, ones, product, error) : status;
}

/* A column of the table, else of another file. */
static mtm_status read_filter(const color_request *request, const mtm_spectrum_table *table, const char *name,
                              mtm_spectrum *filter, mtm_error *error) {
    const mtm_spectrum_kind kind = MTM_KIND_REFLECTANCE;
    const mtm_status status = mtm_spectrum_table_column(table, request->input, name, kind, filter, error);
    return status == MTM_OK || strchr(name, ':') == NULL ? status
                                                         : mtm_spectrum_read(".", name, kind, filter, error);
}

static mtm_status add_filter(const char *name, const mtm_spectrum *filter, viewing *v, mtm_error *error) {
    double coefficients[MTM_DIMENSION_MAX];
    v->light = mtm_spectrum_multiply(&v->light, filter);
    if (json_array_append_new(v->filters, make_text(name)) != 0) return fail_memory(name, error);
    if (v->basis == NULL) return MTM_OK;
    const mtm_status status = mtm_basis_encode(v->basis, filter, coefficients, error);
    return status == MTM_OK ? mtm_basis_multiply(v->basis, v->filter, coefficients, v->filter, error)
                            : status;
}

/* A value of --through is a filter if there is one of that whole name, else a list of them. */
static mtm_status add_filters(const color_request *request, const mtm_spectrum_table *table,
                              const char *value, viewing *v, mtm_error *error) {
    mtm_spectrum filter;
    mtm_status status = read_filter(request, table, value, &filter, error);
    if (status == MTM_OK) return add_filter(value, &filter, v, error);
    if (status == MTM_MEMORY) return status;
    char *names = strdup(value);
    char *name = names;
    status = name == NULL ? fail_memory(request->input, error) : MTM_OK;
    while (name != NULL && status == MTM_OK) {
        char *comma = strchr(name, ',');
        if (comma != NULL) *comma = '\0';
        status = read_filter(request, table, name, &filter, error);
        if (status == MTM_OK) status = add_filter(name, &filter, v, error);
        name = comma == NULL ? NULL : comma + 1;
    }
    free(names);
    return status;
}

/* Light and source come to y = 1 of the light on white, so that the basis answers for the filters' error as well. */
static mtm_status scale_light(viewing *v, mtm_error *error) {
    const double y = mtm_xyz_of(&v->light, &v->observer).y;
    const mtm_status status = mtm_light_normalize(&v->light, &v->observer, &v->light, error);
    if (status != MTM_OK) return status;
    v->source = mtm_spectrum_scale(&v->source, 1 / y);
    v->white = mtm_xyz_of(&v->light, &v->observer);
    return MTM_OK;
}

/* Pictures scale every light by the luminance of CIE 1931, whoever looks. */
static mtm_status make_displays(viewing *v, mtm_error *error) {
    mtm_observer standard;
    mtm_spectrum shown;
    mtm_status status = mtm_observer_get("cie1931", &standard, error);
    if (status == MTM_OK) status = mtm_light_normalize(&v->light, &standard, &shown, error);
    if (status != MTM_OK) return status;
    const mtm_illumination adapted = mtm_illumination_of(&v->light, &v->observer, v->white.y);
    const mtm_illumination picture = mtm_illumination_of(&shown, &v->observer, 0);
    const double exposure = mtm_xyz_of(&shown, &v->observer).y;
    memcpy(v->srgb_from_xyz, adapted.rgb_from_xyz, sizeof v->srgb_from_xyz);
    for (int i = 0; i < 9; i++)
        v->picture_from_xyz[i / 3][i % 3] = exposure * picture.rgb_from_xyz[i / 3][i % 3];
    return MTM_OK;
}

/* The matrix of a basis leads to a display; with the identity as the display it leads to XYZ. */
static mtm_status make_matrix(viewing *v, mtm_error *error) {
    if (v->basis == NULL) return MTM_OK;
    const mtm_illumination illumination = {
        .light = v->source, .observer = v->observer, .rgb_from_xyz = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    return mtm_basis_matrix(v->basis, &illumination, v->matrix, error);
}

/* A failure that names the option and its value. */
static mtm_status name_option(mtm_status status, const char *option, const char *value, mtm_error *error) {
    return name_failure(name_failure(status, value, NULL, error), option, NULL, error);
}

static mtm_status filter_light(const color_request *request, const mtm_spectrum_table *table, viewing *v,
                               mtm_error *error) {
    mtm_status status = MTM_OK;
    v->light = v->source;
    for (int i = 0; i < MTM_DIMENSION_MAX; i++) v->filter[i] = 1;
    for (int i = 0; i < request->through_count && status == MTM_OK; i++)
        status = name_option(add_filters(request, table, request->through[i], v, error), "--through",
                             request->through[i], error);
    if (status != MTM_OK) return status;
    return request->through_count == 0
               ? name_option(scale_light(v, error), "--observer", request->observer,
                             error) /* blind to the light */
               : name_option(scale_light(v, error), "--through", "the filtered light", error);
}

static mtm_status set_up(const color_request *request, const mtm_spectrum_table *table, viewing *v,
                         mtm_error *error) {
    mtm_status status = name_option(open_illuminant(request->illuminant, &v->source, error), "--illuminant",
                                    request->illuminant, error);
    if (status == MTM_OK)
        status = name_option(open_observer(request->observer, &v->observer, error), "--observer",
                             request->observer, error);
    if (status == MTM_OK && request->basis != NULL)
        status =
            name_option(open_basis(v, request->basis, &v->basis, error), "--basis", request->basis, error);
    if (status == MTM_OK) status = filter_light(request, table, v, error);
    if (status == MTM_OK && !v->observer.is_camera)
        status = name_option(make_displays(v, error), "--illuminant", request->illuminant, error);
    return status == MTM_OK ? make_matrix(v, error) : status;
}

/* XYZ of a reflectance, or a camera's response; y is 1 for the perfect reflector. */
static mtm_status look(const viewing *v, const mtm_spectrum *reflectance, mtm_xyz *xyz, mtm_error *error) {
    double coefficients[MTM_DIMENSION_MAX];
    if (v->basis == NULL) {
        const mtm_spectrum stimulus = mtm_spectrum_multiply(&v->light, reflectance);
        *xyz = mtm_xyz_of(&stimulus, &v->observer);
        return MTM_OK;
    }
    mtm_status status = mtm_basis_encode(v->basis, reflectance, coefficients, error);
    if (status == MTM_OK) status = mtm_basis_multiply(v->basis, coefficients, v->filter, coefficients, error);
    if (status != MTM_OK) return status;
    const mtm_rgb color = mtm_basis_color(mtm_basis_dimension(v->basis), v->matrix, coefficients);
    *xyz = (mtm_xyz){color.r, color.g, color.b}; /* the display is the identity */
    return MTM_OK;
}

static json_t *describe_encoded(mtm_rgb linear) {
    const double encoded[3] = {mtm_srgb_encode(linear.r), mtm_srgb_encode(linear.g),
                               mtm_srgb_encode(linear.b)};
    return make_numbers(3, encoded);
}

static json_t *describe_chromaticity(mtm_xyz xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    const double xy[2] = {xyz.x / sum, xyz.y / sum};
    return sum == 0 ? json_null() : make_numbers(2, xy);
}

static json_t *describe_xyz(const viewing *v, const char *name, mtm_xyz xyz) {
    const mtm_lab lab = mtm_lab_from_xyz(xyz, v->white);
    const mtm_rgb srgb = apply(v->srgb_from_xyz, xyz);
    const double percent[3] = {100 * xyz.x, 100 * xyz.y, 100 * xyz.z};
    const double lab_numbers[3] = {lab.l, lab.a, lab.b};
    const double linear[3] = {srgb.r, srgb.g, srgb.b};
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "name", make_text(name), "xyz",
                     make_numbers(3, percent), "xy", describe_chromaticity(xyz), "lab",
                     make_numbers(3, lab_numbers), "srgb_linear", make_numbers(3, linear), "srgb",
                     describe_encoded(srgb), "srgb_picture",
                     describe_encoded(apply(v->picture_from_xyz, xyz)));
}

static json_t *describe_response(const char *name, mtm_xyz xyz) {
    const double response[3] = {xyz.x, xyz.y, xyz.z};
    return json_pack("{s:o, s:o}", "name", make_text(name), "camera", make_numbers(3, response));
}

/* Beyond this, numbers that are made of X, Y and Z could leave those that JSON can hold. */
static bool is_printable(mtm_xyz xyz) {
    return fabs(xyz.x) + fabs(xyz.y) + fabs(xyz.z) < 1e100;
}

static mtm_status describe_column(const color_request *request, const mtm_spectrum_table *table,
                                  const viewing *v, const char *name, json_t **color, mtm_error *error) {
    mtm_spectrum reflectance;
    mtm_xyz xyz;
    mtm_status status =
        mtm_spectrum_table_column(table, request->input, name, MTM_KIND_REFLECTANCE, &reflectance, error);
    if (status == MTM_OK) status = name_failure(look(v, &reflectance, &xyz, error), "--basis", NULL, error);
    if (status != MTM_OK) return status;
    if (!is_printable(xyz)) {
        (void)snprintf(error->message, sizeof error->message,
                       "%s: column '%.64s' is no reflectance, its color is too large", request->input, name);
        return MTM_NUMERIC;
    }
    *color = v->observer.is_camera ? describe_response(name, xyz) : describe_xyz(v, name, xyz);
    return MTM_OK;
}

static mtm_status describe_columns(const color_request *request, const mtm_spectrum_table *table,
                                   const viewing *v, json_t *colors, mtm_error *error) {
    for (int i = 0; i < table->column_count; i++) {
        json_t *color = NULL;
        const mtm_status status = describe_column(request, table, v, table->names[i], &color, error);
        if (status != MTM_OK) return status;
        if (json_array_append_new(colors, color) != 0) return fail_memory(request->input, error);
    }
    return MTM_OK;
}

/* What has no meaning for a light (MTM_NUMERIC) is null; any other failure is one. */
static mtm_status find_rendering(const mtm_spectrum *light, mtm_color_rendering_result *rendering,
                                 bool *has_temperature, bool *has_rendering, mtm_error *error) {
    mtm_status status = mtm_color_rendering(light, rendering, error);
    *has_temperature = *has_rendering = status == MTM_OK;
    if (status != MTM_NUMERIC) return status;
    status = mtm_color_temperature(light, &rendering->temperature, error);
    *has_temperature = status == MTM_OK;
    return status == MTM_NUMERIC ? MTM_OK : status;
}

/* Of the light on the samples, for CIE 1931, as color temperature and rendering are defined. */
static mtm_status describe_light(const mtm_spectrum *light, json_t **object, mtm_error *error) {
    mtm_observer standard;
    mtm_spectrum scaled;
    mtm_color_rendering_result rendering;
    bool has_temperature = false;
    bool has_rendering = false;
    mtm_status status = mtm_observer_get("cie1931", &standard, error);
    if (status == MTM_OK) status = mtm_light_normalize(light, &standard, &scaled, error);
    if (status == MTM_OK)
        status = find_rendering(&scaled, &rendering, &has_temperature, &has_rendering, error);
    if (status != MTM_OK) return status;
    *object =
        json_pack("{s:o, s:o, s:o, s:o, s:o}", "xy", describe_chromaticity(mtm_xyz_of(&scaled, &standard)),
                  "cct", has_temperature ? json_real(rendering.temperature.kelvin) : json_null(), "duv",
                  has_temperature ? json_real(rendering.temperature.duv) : json_null(), "ra",
                  has_rendering ? json_real(rendering.general) : json_null(), "r",
                  has_rendering ? make_numbers(MTM_TEST_COLORS, rendering.special) : json_null());
    return MTM_OK;
}

static mtm_status describe(const color_request *request, const mtm_spectrum_table *table, const viewing *v,
                           json_t **document, mtm_error *error) {
    json_t *light = NULL;
    json_t *colors = json_array();
    mtm_status status = describe_columns(request, table, v, colors, error);
    if (status == MTM_OK)
        status =
            name_option(describe_light(&v->light, &light, error), "--illuminant", request->illuminant, error);
    if (status != MTM_OK) {
        json_decref(colors);
        return status;
    }
    *document =
        json_pack("{s:o, s:o, s:o*, s:s*, s:o, s:o}", "illuminant", make_text(request->illuminant),
                  "observer", make_text(request->observer), "through", json_incref(v->filters), "basis",
                  v->basis == NULL ? NULL : mtm_basis_name(v->basis), "light", light, "colors", colors);
    return *document == NULL ? fail_memory(request->input, error) : MTM_OK;
}

/* Characters of UTF-8 text: the bytes that do not continue one. */
static int width_of(const char *text) {
    int width = 0;
    for (; *text != '\0'; text++) width += ((unsigned char)*text & 0xC0) != 0x80;
    return width;
}

static double number_at(const json_t *array, size_t index) {
    return json_number_value(json_array_get(array, index));
}

static void print_light(const json_t *light) {
    const json_t *xy = json_object_get(light, "xy");
    const json_t *cct = json_object_get(light, "cct");
    const json_t *ra = json_object_get(light, "ra");
    (void)printf("light       x %.4f, y %.4f", number_at(xy, 0), number_at(xy, 1));
    if (json_is_real(cct))
        (void)printf(", %.0f K, Duv %+.4f", json_real_value(cct),
                     json_real_value(json_object_get(light, "duv")));
    if (json_is_real(ra)) (void)printf(", Ra %.1f", json_real_value(ra));
    (void)printf("\n");
}

static void print_header(const json_t *document) {
    size_t i = 0;
    json_t *filter = NULL;
    const json_t *filters = json_object_get(document, "through");
    const json_t *basis = json_object_get(document, "basis");
    (void)printf("illuminant  %s", json_string_value(json_object_get(document, "illuminant")));
    json_array_foreach(filters, i, filter) {
        (void)printf("%s%s", i == 0 ? " through " : ", ", json_string_value(filter));
    }
    (void)printf("\n");
    print_light(json_object_get(document, "light"));
    (void)printf("observer    %s\n", json_string_value(json_object_get(document, "observer")));
    if (basis != NULL) (void)printf("basis       %s\n", json_string_value(basis));
    (void)printf("\n");
}

static void print_color(const json_t *color) {
    const json_t *xyz = json_object_get(color, "xyz");
    const json_t *lab = json_object_get(color, "lab");
    const json_t *srgb = json_object_get(color, "srgb");
    const json_t *camera = json_object_get(color, "camera");
    for (size_t i = 0; camera != NULL && i < 3; i++) (void)printf(" %9.5f", number_at(camera, i));
    for (size_t i = 0; xyz != NULL && i < 3; i++) (void)printf(" %8.3f", number_at(xyz, i));
    for (size_t i = 0; lab != NULL && i < 3; i++) (void)printf(" %8.3f", number_at(lab, i));
    if (srgb != NULL) (void)printf("  #");
    for (size_t i = 0; srgb != NULL && i < 3; i++)
        (void)printf("%02x", (unsigned)lround(255 * number_at(srgb, i)));
    (void)printf("\n");
}

/* The same facts for people. */
static void print_table(const json_t *document, bool is_camera) {
    size_t i = 0;
    json_t *color = NULL;
    const json_t *colors = json_object_get(document, "colors");
    int width = width_of("name");
    json_array_foreach(colors, i, color) {
        const int own = width_of(json_string_value(json_object_get(color, "name")));
        width = own > width ? own : width;
    }
    print_header(document);
    (void)printf("%-*s", width, "name");
    if (is_camera)
        (void)printf(" %9s %9s %9s\n", "R", "G", "B");
    else
        (void)printf(" %8s %8s %8s %8s %8s %8s  %s\n", "X", "Y", "Z", "L*", "a*", "b*", "sRGB");
    json_array_foreach(colors, i, color) {
        const char *name = json_string_value(json_object_get(color, "name"));
        print_plainly(stdout, name);
        (void)printf("%*s", width - width_of(name), "");
        print_color(color);
    }
}

static int color(const subcommand *command, const color_request *request) {
    mtm_error error = {""};
    mtm_spectrum_table table;
    viewing v = {.filters = request->through_count > 0 ? json_array() : NULL};
    json_t *document = NULL;
    mtm_status status = mtm_spectrum_table_read(request->input, &table, &error);
    if (status == MTM_OK) {
        status = set_up(request, &table, &v, &error);
        if (status == MTM_OK) status = describe(request, &table, &v, &document, &error);
        mtm_spectrum_table_free(&table);
    }
    if (status == MTM_OK && request->is_json) print_document(document);
    if (status == MTM_OK && !request->is_json) print_table(document, v.observer.is_camera);
    json_decref(document);
    json_decref(v.filters);
    mtm_basis_destroy(v.basis);
    return status == MTM_OK ? EXIT_DONE : fail_command(command, &error);
}

static void read_option(argument_walk *walk, const command_option *option, const char *value,
                        color_request *request) {
    if (option == NULL && request->input != NULL)
        fail_usage(walk, "one table at a time, not \"%s\" and \"%s\"", request->input, value);
    else if (option == NULL)
        request->input = value;
    else if (is_option(option, "--illuminant"))
        request->illuminant = value;
    else if (is_option(option, "--observer"))
        request->observer = value;
    else if (is_option(option, "--basis"))
        request->basis = value;
    else if (is_option(option, "--json"))
        request->is_json = true;
    else if (request->through_count < THROUGH_MAX)
        request->through[request->through_count++] = value;
    else
        fail_usage(walk, "more than %d times --through", THROUGH_MAX);
}

static int run(const subcommand *command, int argc, char **argv) {
    color_request request = {.illuminant = "D65", .observer = "cie1931"};
    argument_walk walk = walk_arguments(command, argc, argv);
    const command_option *option = NULL;
    const char *value = NULL;
    while (next_argument(&walk, &option, &value)) read_option(&walk, option, value, &request);
    if (!walk.is_over && request.input == NULL) fail_usage(&walk, "a table of spectra is needed");
    return walk.is_over ? walk.exit_status : color(command, &request);
}

const subcommand color_command = {
    .name = "color",
    .arguments = "SPECTRA.csv [options]",
    .summary =
        "Tell the colors of reflectances under a light: XYZ, CIELAB, sRGB.\n"
        "White is the perfect reflector under the light on the samples, behind its filters; with --basis "
        "too, so\n"
        "that the difference to a run without it is the basis's error. A value of --through is a column if "
        "there\n"
        "is one of that name, else a list. sRGB is adapted to D65; with a camera the colors are its R, G, B.",
    .options = options,
    .run = run,
};
