/* SPDX-License-Identifier: BSD-3-Clause
 * Materials and lights: the palette of a scene, and its design. */
#ifndef METAMER_PALETTE_H
#define METAMER_PALETTE_H

#include "metamer/basis.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    MTM_NAME_MAX = 63,      /* bytes of a name */
    MTM_MATERIALS_MAX = 82, /* materials of a palette */
    MTM_LIGHTS_MAX = 256,   /* lights of a palette */
};

typedef struct mtm_material {
    char name[MTM_NAME_MAX + 1];
    mtm_spectrum reflectance;
} mtm_material;

typedef struct mtm_light {
    char name[MTM_NAME_MAX + 1];
    mtm_spectrum emission; /* as given, after filters; mtm_palette_mix scales it */
} mtm_light;

/* Names are unique among the materials and among the lights. */
typedef struct mtm_palette {
    int material_count;
    mtm_material *materials;
    int light_count;
    mtm_light *lights;
} mtm_palette;

MTM_API void mtm_palette_free(mtm_palette *palette);
/* A copy of its own. MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_palette_copy(const mtm_palette *palette, mtm_palette *copy,
                                              mtm_error *error);

/* Three materials (soft, middle, dense) and three lights (daylight, lamp, tube) for a volume nobody has described. MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_palette_defaults(mtm_palette *palette, mtm_error *error);

/* Reads {"materials": […], "lights": […]} as described in docs/scene.md; CSV files are looked for beside it. Every
 * error names the file, the key and the value. On success release with mtm_palette_free. */
MTM_API MTM_CHECK mtm_status mtm_palette_read(const char *path, mtm_palette *palette, mtm_error *error);

/* The same from text; `document` names it in messages, `folder` is where its CSV files are. NULL: an embedded document
 * that stands alone and may name none. MTM_FORMAT; MTM_IO, MTM_LIMIT and MTM_MEMORY as its files give them. */
MTM_API MTM_CHECK mtm_status mtm_palette_parse(const char *document, const char *text, const char *folder,
                                               mtm_palette *palette, mtm_error *error);

/* The palette as a document that stands alone: every spectrum as 81 values that read back exactly. Release with
 * mtm_text_free; NULL when out of memory. */
MTM_API char *mtm_palette_format(const mtm_palette *palette);

/* Index by name, or -1. */
MTM_API int mtm_palette_find_material(const mtm_palette *palette, const char *name);
MTM_API int mtm_palette_find_light(const mtm_palette *palette, const char *name);

/* The name that is most like one that was not found, for messages; "" where the palette has none. */
MTM_API const char *mtm_palette_nearest_material(const mtm_palette *palette, const char *name);
MTM_API const char *mtm_palette_nearest_light(const mtm_palette *palette, const char *name);

/* The scene's light: intensity · Σ weights[i]·Eᵢ over the palette's lights, each scaled to Y = 1 on the perfect
 * reflector (CIE 1931) first; weights are not renormalised. A light without luminance, which no document can hold, adds
 * nothing. */
MTM_API mtm_spectrum mtm_palette_mix(const mtm_palette *palette, const double *weights, double intensity);

/* Takes the reflectances of materials and the lights of `other` that have the same name, and adds its other lights.
 * MTM_ARGUMENT where nothing is taken: no material in common and no light at all; MTM_LIMIT beyond MTM_LIGHTS_MAX
 * lights of both together; MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_palette_override(mtm_palette *palette, const mtm_palette *other,
                                                  mtm_error *error);

/* What the cells of a palette, a material alone under a light alone, are to look like. Colors are those of the picture at
 * weight 1: linear sRGB without adaptation, as XYZ with Y = 1 for white, compared by CIEDE2000 against D65. */
typedef struct mtm_cell {
    int material, light;
} mtm_cell;

typedef enum mtm_goal_kind {
    MTM_GOAL_COLOR,     /* the cell has this color */
    MTM_GOAL_SAME,      /* the cell has the color of the other cell */
    MTM_GOAL_DIFFERENT, /* the cell's color is at least `least` from the other's */
} mtm_goal_kind;

typedef struct mtm_goal {
    mtm_goal_kind kind;
    mtm_cell cell;
    mtm_cell other; /* of SAME and DIFFERENT; material -1: black, for DIFFERENT */
    mtm_xyz color;  /* of COLOR */
    double least;   /* CIEDE2000, of DIFFERENT */
    double weight;  /* how much it counts where goals block each other; 1 is usual */
} mtm_goal;

/* A goals document (docs/design.md): which spectra are given and which are to be found, and what the cells are to look
 * like. */
typedef struct mtm_goals mtm_goals;

/* Reads a goals document strictly, as mtm_scene_read does; tables of spectra are looked for beside it. The errors name
 * file, key and value: MTM_FORMAT; MTM_IO, MTM_LIMIT and MTM_MEMORY as its files give them. Release with mtm_goals_destroy
 * (NULL allowed). */
MTM_API MTM_CHECK mtm_status mtm_goals_read(const char *path, mtm_goals **goals, mtm_error *error);

/* The same from text; `document` names it in messages, `folder` is where its files are. NULL: it may name none. */
MTM_API MTM_CHECK mtm_status mtm_goals_parse(const char *document, const char *text, const char *folder,
                                             mtm_goals **goals, mtm_error *error);
MTM_API void mtm_goals_destroy(mtm_goals *goals);

/* Parts of the method that can be left out, to see what each brings. */
typedef enum mtm_design_device {
    MTM_DESIGN_WITHOUT_BOUNDS = 1, /* every spectrum that is found may be artificial */
    MTM_DESIGN_WITHOUT_FULL = 2,   /* colors by the goals' basis alone */
    MTM_DESIGN_WITHOUT_BASIS = 4,  /* colors by full spectra alone */
    MTM_DESIGN_WITHOUT_STARTS = 8, /* one start */
} mtm_design_device;

typedef struct mtm_design_options {
    unsigned without;      /* mtm_design_device, or-ed; default 0 */
    int thread_count;      /* 0: all processors; the result is the same */
    mtm_progress progress; /* default: nobody listens */
} mtm_design_options;

MTM_API mtm_design_options mtm_design_defaults(void);

/* Where a spectrum of a design is from, and what could show it. */
typedef enum mtm_honesty {
    MTM_HONESTY_GIVEN,    /* the goals hold it */
    MTM_HONESTY_MEASURED, /* found in a table of measured spectra */
    MTM_HONESTY_PHYSICAL, /* designed, reflectances 0 … 1 and lights not negative: something could have it */
    MTM_HONESTY_COEFFICIENTS, /* artificial, but its coefficients in the basis are a physical spectrum's */
    MTM_HONESTY_ARTIFICIAL,   /* nothing real has it */
} mtm_honesty;

/* "physical" and so on. */
MTM_API const char *mtm_honesty_name(mtm_honesty honesty);

/* What became of a goal, by full spectra and as a picture in the goals' basis shows it. */
typedef struct mtm_goal_result {
    mtm_goal goal;
    mtm_xyz asked; /* COLOR: the color; SAME and DIFFERENT: the other cell's, by full spectra */
    mtm_xyz achieved, achieved_basis;
    double difference, difference_basis; /* CIEDE2000 from what it is compared with */
    double ciede2000,
        ciede2000_basis;       /* how far it is from what was asked: `difference`, or what lacks of `least` */
    bool is_met, is_met_basis; /* within the goals' tolerance */
} mtm_goal_result;

enum { MTM_BLOCKERS_MAX = 8 };

/* Why a goal is not met. */
typedef struct mtm_design_problem {
    int goal;           /* index of its result */
    bool is_basis_only; /* full spectra meet it, the basis does not */
    bool is_proven;     /* no spectra of the kind asked for could meet it together with the blockers */
    int blocker_count;  /* other goals without any one of which it would be nearer, or met */
    int blockers[MTM_BLOCKERS_MAX]; /* indices of results */
    char reason[512];               /* a sentence for people */
} mtm_design_problem;

typedef struct mtm_design {
    mtm_palette palette;
    mtm_honesty *materials, *lights; /* one for each of the palette's */
    char (*material_origins)[256];   /* "table.csv:column" of measured ones, else "" */
    char basis[32];
    double tolerance;
    int result_count;
    mtm_goal_result *results; /* in the order of the goals, recipes expanded in place */
    int problem_count;
    mtm_design_problem *problems;
    double objective; /* what was made small: Σ ½·(missed CIEDE2000)²/softness and the spectra's roughness */
    int start_count; /* that were tried */
} mtm_design;

/* Finds the spectra. Goals that cannot be met are met as nearly as they can together, and problems say why; that is no
 * failure. The same numbers for every thread count, the same to 1e-6 on every machine. MTM_CANCELLED; MTM_NUMERIC and
 * MTM_MEMORY. Release with mtm_design_destroy (NULL allowed). */
MTM_API MTM_CHECK mtm_status mtm_design_find(const mtm_goals *goals, const mtm_design_options *options,
                                             mtm_design **design, mtm_error *error);
MTM_API void mtm_design_destroy(mtm_design *design);

/* The report as a JSON document (docs/files.md); `seconds` is what it took. Release with mtm_text_free; NULL when out of
 * memory. */
MTM_API char *mtm_design_format(const mtm_design *design, double seconds);

/* Two reflectances, each 0 … 1, that show one color under a first light and part under a second. */
typedef struct mtm_mismatch {
    double
        separation; /* CIEDE2000 of what the picture shows under the second: linear sRGB clipped, against D65 */
    mtm_spectrum reflectances[2];
} mtm_mismatch;

/* Bounds on second differences of neighboring samples: the least there may be, for what is hardly more than a line, and
 * that of smooth materials (of 473 measured ones, the ACES, CES, Vrhel and CIE test color sets, 58 % bend no more). */
#define MTM_MISMATCH_BEND_MIN    1e-3
#define MTM_MISMATCH_BEND_SMOOTH 0.015

/* Finds the two that part farthest among all that show `color`, linear sRGB (not clipped) under `first`, to about 2e-8 of
 * it. `bend` bounds their second differences, MTM_MISMATCH_BEND_MIN at least; 0: any curve, and those found are 0 or 1 at
 * most wavelengths. The search may miss a little (Logvinenko, Funt, Godau, IEEE TIP 23(1), 2014; Finlayson, Morovic, JOSA A 22(5), 2005).
 * MTM_NUMERIC where no such reflectance has the color; MTM_MEMORY. */
MTM_API MTM_CHECK mtm_status mtm_mismatch_find(const mtm_illumination *first, const mtm_illumination *second,
                                               mtm_rgb color, double bend, mtm_mismatch *result,
                                               mtm_error *error);

/* Color differences, CIEDE2000, by which colors are judged:
 *   up to MATCH they look the same, side by side;
 *   up to SIMILAR they are hard to tell apart where they do not touch: half of people do not, even of large marks (M.
 * Stone, D. A. Szafir, V. Setlur, An Engineering Model for Color Difference as a Function of Size, CIC 2014: 5.1 … 5.3 along
 * L*, a*, b*, more for small marks);
 *   up to INVISIBLE from black there is no light to speak of: 0.4 % of white, less than the flare that sRGB expects. */
#define MTM_DIFFERENCE_MATCH     1.0
#define MTM_DIFFERENCE_SIMILAR   5.0
#define MTM_DIFFERENCE_INVISIBLE 2.0

typedef enum mtm_verdict { MTM_VERDICT_MATCH, MTM_VERDICT_SIMILAR, MTM_VERDICT_DIFFER } mtm_verdict;

MTM_API mtm_verdict mtm_verdict_of(double ciede2000);

/* Two materials that match under one light, not both invisible there, seen under another. */
typedef struct mtm_metamers {
    int materials[2];
    int match_light, other_light;
    double difference; /* CIEDE2000 of the two under the other light */
    double largest;    /* of any two that match there in their color (mtm_mismatch_find) */
    double
        largest_smooth; /* of two that bend by MTM_MISMATCH_BEND_SMOOTH at most; NAN where none has the color */
} mtm_metamers;

enum { MTM_METAMERS_MAX = 16 /* of an analysis, since each takes tens of milliseconds */ };

/* What a palette shows: every material alone under every light alone, at weight 1, as a picture by full spectra does. */
typedef struct mtm_analysis {
    int material_count, light_count;
    mtm_lab *
        colors; /* clipped, to each vision of severity 1: [(vision·light_count + light)·material_count + material] */
    int metamer_count;
    mtm_metamers metamers[MTM_METAMERS_MAX]; /* by light, then materials, then other light */
    int metamers_left_out;
} mtm_analysis;

/* Analyzes a palette for an observer; `adapted_y` as in mtm_illumination_of. Materials that match and are not physical
 * have NAN for both largest separations. MTM_MEMORY. Release with mtm_analysis_free. */
MTM_API MTM_CHECK mtm_status mtm_palette_analyze(const mtm_palette *palette, const mtm_observer *observer,
                                                 double adapted_y, mtm_analysis *analysis, mtm_error *error);
MTM_API void mtm_analysis_free(mtm_analysis *analysis);

/* CIEDE2000 of a material under a light from another one, from itself under another light, or from black. */
MTM_API double mtm_analysis_difference(const mtm_analysis *analysis, mtm_vision vision, int material,
                                       int light, int other_material, int other_light);
MTM_API double mtm_analysis_from_black(const mtm_analysis *analysis, mtm_vision vision, int material,
                                       int light);

#ifdef __cplusplus
}
#endif
#endif
