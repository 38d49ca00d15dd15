/* SPDX-License-Identifier: BSD-3-Clause
 * docs/accuracy.md: what was measured, in words and tables. The words that judge are backed by bounds in
 * tests/accuracy. */
#include "document.h"

#include "output.h"
#include "tables.h"

static const product_errors *held_out(const measurements *made, model_family family, int dimension) {
    return measured_products(made, SET_HELD_OUT, family, dimension);
}

static void print_answer(FILE *stream, const measurements *made) {
    const error_summary factors = held_out(made, FAMILY_FACTORS, 7)->products[0];
    const error_summary sharpened = held_out(made, FAMILY_SHARPENED, 7)->products[0];
    const error_summary rgb = held_out(made, FAMILY_RGB, 0)->products[0];
    (void)fprintf(stream,
                  "# Accuracy\n\n"
                  "How far colors in each basis are from those of full spectra. `make accuracy`\n"
                  "measures this and prints this file.\n\n"
                  "## The answer\n"
                  "- **Up to six materials: `materials`.** It is exact under every light, and `auto`\n"
                  "  takes it. Its coefficients are shares of the palette's own reflectances, so there\n"
                  "  is nothing to approximate, and nothing to multiply either.\n"
                  "- **More materials, filters, light that is reflected again: `factors:7`.** A light\n"
                  "  on a reflectance, neither of which it was fitted to, is off by %.2f CIEDE2000 on\n"
                  "  average, 95 %% of them by less than %.2f. A difference of 1 is about what an eye\n"
                  "  can just see between two patches side by side.\n"
                  "- **The paper's construction, `sharpened:7`,** is off by %.2f (95 %%: %.2f). It is\n"
                  "  there to compare with.\n"
                  "- **RGB** is off by %.2f (95 %%: %.2f), and no two metamers ever part in it.\n"
                  "- **The reference is `wavelengths`,** for 81 numbers per pixel; `wavelengths:31` is\n"
                  "  nearly as good for 31.\n\n",
                  factors.mean, factors.p95, sharpened.mean, sharpened.p95, rgb.mean, rgb.p95);
    print_headline_table(stream, made);
    (void)fprintf(stream, "![Mean error by dimension](pictures/accuracy.svg)\n\n");
}

static void print_method(FILE *stream, const measurements *made) {
    (void)fprintf(stream,
                  "## How it was measured\n"
                  "Every number is CIEDE2000 between the color of the true product, summed over 81\n"
                  "samples from 380 to 780 nm for the CIE 1931 observer, and the color that the model\n"
                  "gives; white is the light. Negative parts of a model's color count as 0, as on a\n"
                  "display.\n\n"
                  "- **Lights:** %d that no basis was fitted to, in three classes (smooth, LED,\n"
                  "  fluorescent) with a third of the draws each; and %d other lamps\n"
                  "  (Houser and others 2013: LED clusters, fluorescent, discharge).\n"
                  "- **Reflectances:** %d of the ColorChecker and of the color evaluation samples\n"
                  "  CES99, the half that no basis was fitted to.\n"
                  "  [accuracy/split.csv](../accuracy/split.csv) lists both.\n"
                  "- **Draws:** %d per set, the same ones for every model; the generator is in\n"
                  "  [accuracy/random.c](../accuracy/random.c). A draw is a light and three\n"
                  "  reflectances, which it meets one after the other. Over all %d pairs of light and\n"
                  "  reflectance, once each, `factors:7` has the mean %.3f.\n"
                  "- **Exposure-matched:** products of three get dark, and dark colors hide errors. So\n"
                  "  both colors are brought back to the luminance of the first product.\n\n"
                  "The models: `factors` and `sharpened` as the library has them; `sharpened` with the\n"
                  "exact light of `factors`, and `factors` with the encoded light of `sharpened`;\n"
                  "Peercy's matrices (SIGGRAPH 1993), d×d for every reflectance and d² multiplications\n"
                  "instead of d, in the subspace of `sharpened` with an exact light; unsharpened\n"
                  "products of that subspace's principal components, one by one; RGB, linear sRGB of\n"
                  "the light times that of the reflectances under D65; Bradford RGB, the same in the\n"
                  "cone space of the Bradford transform.\n\n",
                  made->light_count, made->lamp_count, made->reflectance_count, made->options.draw_count,
                  made->pair_count, measured_products(made, SET_PAIRS, FAMILY_FACTORS, 7)->products[0].mean);
}

static void print_curves(FILE *stream) {
    (void)fprintf(stream,
                  "## The curves\n"
                  "Coefficient i of a spectrum is the sum of its samples with the weights on the left.\n"
                  "What a pixel then stands for is the sum of its coefficients, each times its curve on\n"
                  "the right.\n\n"
                  "`factors:7`, fitted; no weight is negative, so a physical reflectance has\n"
                  "coefficients of 0 … 1:\n\n"
                  "![Curves of factors:7](pictures/basis-factors-7.svg)\n\n"
                  "`sharpened:7`, principal components turned toward seven intervals of 400 to 700 nm:\n\n"
                  "![Curves of sharpened:7](pictures/basis-sharpened-7.svg)\n\n");
}

static void print_missing(FILE *stream, const measurements *made) {
    bool is_any = false;
    for (int d = MODEL_DIMENSION_MIN; d <= MODEL_DIMENSION_MAX; d++) {
        if (!made->is_missing[model_index(FAMILY_SHARPENED, d)]) continue;
        (void)fprintf(stream, "%s`sharpened:%d`", is_any ? ", " : " The library refuses ", d);
        is_any = true;
    }
    (void)fprintf(stream, is_any ? " as ill-conditioned.\n" : "\n");
}

static void print_dimensions(FILE *stream, const measurements *made) {
    (void)fprintf(stream, "## By dimension\nMean / 95 %%, held-out lights on held-out reflectances.");
    print_missing(stream, made);
    (void)fprintf(stream, "\n### One reflectance\n");
    print_dimension_table(stream, made, SET_HELD_OUT, PRODUCT_ONE);
    (void)fprintf(stream, "### Two reflectances\n");
    print_dimension_table(stream, made, SET_HELD_OUT, PRODUCT_TWO);
    (void)fprintf(stream, "### Three reflectances\n");
    print_dimension_table(stream, made, SET_HELD_OUT, PRODUCT_THREE);
    (void)fprintf(stream, "### Three reflectances, exposure-matched\n");
    print_dimension_table(stream, made, SET_HELD_OUT, PRODUCT_MATCHED);
}

static void print_lights(FILE *stream, const measurements *made) {
    (void)fprintf(stream, "## By class of light\nOne reflectance, mean.\n\n");
    print_class_table(stream, made);
    (void)fprintf(stream,
                  "## Other lamps\n"
                  "Each of %d lamps on held-out reflectances: those of the 401 in\n"
                  "[lights_houser401.csv](../data/spectra/lights_houser401.csv) that no basis was fitted\n"
                  "to (the others are CIE illuminants, or nearly).\n\n",
                  made->lamp_count);
    print_set_table(stream, made, SET_HOUSER);
}

static void print_metamers(FILE *stream, const measurements *made) {
    const metamer_errors *rgb = &made->metamers[model_index(FAMILY_RGB, 0)];
    (void)fprintf(stream,
                  "## Metamers\n"
                  "%d pairs of reflectances that are exactly equal under D65\n"
                  "([metamers_constructed_D65_spectra.csv](../tests/data/expected/"
                  "metamers_constructed_D65_spectra.csv)).\n"
                  "A basis should keep them equal there, and part them under D50, A, FL2, FL11, LED-B1\n"
                  "and LED-RGB1 as far as they truly part: by %.2f on average, by %.2f at most. RGB\n"
                  "cannot: equal colors have equal coefficients, whatever the light, so its error is\n"
                  "the whole split. For a single reflectance, Peercy's matrices have nothing to\n"
                  "multiply and are `sharpened` with an exact light.\n\n",
                  made->metamer_count, rgb->true_split.mean, rgb->true_split.max);
    print_metamer_table(stream, made);
}

static void print_filters(FILE *stream, const measurements *made) {
    (void)fprintf(stream,
                  "## Filters\n"
                  "A light through one and two filters onto a reflectance, by products of coefficients.\n"
                  "White is the true filtered light, so nothing is flattered by getting dark, and an\n"
                  "error in the filter itself counts too. (A filter that a scene names with `through`\n"
                  "is multiplied wavelength by wavelength, and is exact.)\n\n");
    print_filter_table(stream, made);
}

static void print_engine(FILE *stream, const measurements *made) {
    const engine_errors *engine = &made->engine;
    (void)fprintf(
        stream,
        "## A picture\n"
        "The scene [examples/engine](../examples/engine/engine.json), %d × %d pixels,\n"
        "rendered in each basis and relit with its three lights, FL11 and LED-B3; against\n"
        "`wavelengths`, over the %d pixels that hold anything. `rgb` is relit as a plain\n"
        "renderer would: its colors under D65, times the light's. The first palette is the\n"
        "scene's own, designed so that its parts merge and vanish, and that their colors are right\n"
        "in `factors:7` under its own three lights, too. Under lights that it was not designed for,\n"
        "seven smooth curves do not follow its steep spectra, and `auto` takes `materials` for it,\n"
        "which does. Its lights are narrow, and hard on the other palettes as well, which are\n"
        "measured: patches of the ColorChecker that no basis was fitted to. Over these,\n"
        "`factors:7` has the mean %.2f.\n\n"
        "All five lights, mean / 95 %%:\n\n",
        engine->edge, engine->edge, engine->pixel_count, engine->measured[ENGINE_FACTORS_7].mean);
    print_engine_table(stream, made);
    (void)fprintf(stream, "`factors:7`, light by light, mean / 95 %% / max:\n\n");
    print_engine_light_table(stream, made);
}

static void print_decisions(FILE *stream, const measurements *made) {
    const product_errors *sharpened = held_out(made, FAMILY_SHARPENED, 7);
    const product_errors *exact = held_out(made, FAMILY_SHARPENED_EXACT, 7);
    const product_errors *factors = held_out(made, FAMILY_FACTORS, 7);
    const product_errors *encoded = held_out(made, FAMILY_FACTORS_ENCODED, 7);
    const product_errors *unsharpened = held_out(made, FAMILY_UNSHARPENED, 7);
    const product_errors *points = held_out(made, FAMILY_POINTS, 0);
    (void)fprintf(stream,
                  "## What was decided, and why\n"
                  "- **The light is exact in `factors`.** The paper encodes the light like a\n"
                  "  reflectance (its eq. 2). But it is known when a picture is lit, and enters the 3×d\n"
                  "  matrix once, whatever its spectrum: exact, at no cost per pixel. Alone, this takes\n"
                  "  `sharpened:7` from %.2f to %.2f; without it, `factors:7` goes from %.2f to %.2f.\n"
                  "  `sharpened` keeps the paper's way, to be what it is compared as.\n"
                  "- **Lights are integrated, never sampled.** Points every 10 nm with plain sums miss\n"
                  "  the lines of fluorescent lamps or count them twice: %.2f on average under these,\n"
                  "  against %.2f under smooth lights.\n"
                  "- **400 to 700 nm is enough for reflectances.** Leaving the rest out costs %.2f.\n"
                  "  `factors` still uses the whole grid.\n"
                  "- **Products need their own basis.** Principal components hold spectra better than\n"
                  "  anything else, but their products, one by one, mean nothing: %.1f. Matrices repair\n"
                  "  that for d² multiplications.\n"
                  "- **The fit uses only spectra whose terms allow it** and that come along, and\n"
                  "  reflectances that are not used to judge it\n"
                  "  ([data/bases](../data/bases/README.md)); anybody can compute it again with `make\n"
                  "  bases`.\n\n",
                  sharpened->products[0].mean, exact->products[0].mean, factors->products[0].mean,
                  encoded->products[0].mean, points->class_mean[2], points->class_mean[0],
                  held_out(made, FAMILY_CUT, 0)->products[0].mean, unsharpened->products[0].mean);
}

static void print_more(FILE *stream, const measurements *made) {
    if (made->set_count <= SETS_IN_REPOSITORY) return;
    (void)fprintf(stream,
                  "## With reflectances that are not in the repository\n"
                  "Three collections that are not included, because the terms they are distributed\n"
                  "under are narrower than metamer's. With `MORE=FOLDER`, `make accuracy` measures with\n"
                  "them too, where FOLDER has them as tables on the 5 nm grid:\n"
                  "`reflectance_munsell1269_matt_5nm.csv`, 1269 matt chips of the Munsell book\n"
                  "(spectral database of the University of Eastern Finland);\n"
                  "`reflectance_opstelten215_5nm.csv`, 215 natural and man-made objects (Opstelten,\n"
                  "1983); `reflectance_cri2012_real210_5nm.csv`, the 210 real samples of CRI2012 (K.\n"
                  "Smet, J. Schanda, L. Whitehead, R. Luo, 2013). Nothing was fitted to any of them.\n\n"
                  "### Half of the draws from %d Munsell chips\n"
                  "Held-out lights. Mean / 95 %%, one reflectance, then three, exposure-matched:\n\n",
                  made->more_reflectance_count);
    print_dimension_table(stream, made, SET_FULL, PRODUCT_ONE);
    print_dimension_table(stream, made, SET_FULL, PRODUCT_MATCHED);
    (void)fprintf(stream, "### The same under the %d lamps\n", made->lamp_count);
    print_set_table(stream, made, SET_FULL_HOUSER);
    (void)fprintf(stream, "### Opstelten, held-out lights\n");
    print_set_table(stream, made, SET_OPSTELTEN);
    (void)fprintf(stream, "### CRI2012, held-out lights\n");
    print_set_table(stream, made, SET_CRI2012);
}

static void print_costs(FILE *stream, const measurements *made, const cost_setting *setting,
                        const basis_cost costs[COST_BASES]) {
    (void)fprintf(stream,
                  "## Why a basis at all?\n"
                  "Error against cost: the engine scene with measured reflectances, %d × %d pixels, %d\n"
                  "cores, %d threads, medians of %d interleaved runs. Times differ from run to run and\n"
                  "from machine to machine; all sections before this one come out the same to the byte.\n\n",
                  setting->engine.edge, setting->engine.edge, mtm_default_thread_count(),
                  setting->engine.thread_count, setting->run_count);
    print_cost_table(stream, made, costs);
}

mtm_status document_write(const measurements *made, const cost_setting *setting,
                          const basis_cost costs[COST_BASES], const char *path, mtm_error *error) {
    output_file file;
    const mtm_status status = output_open(path, &file, error);
    if (status != MTM_OK) return status;
    print_answer(file.stream, made);
    print_method(file.stream, made);
    print_curves(file.stream);
    print_dimensions(file.stream, made);
    print_lights(file.stream, made);
    print_metamers(file.stream, made);
    print_filters(file.stream, made);
    print_engine(file.stream, made);
    print_decisions(file.stream, made);
    print_more(file.stream, made);
    (void)fprintf(file.stream,
                  "## Every number\nHeld-out lights on held-out reflectances, mean / 95 %% / max.\n\n");
    print_full_table(file.stream, made, SET_HELD_OUT);
    print_costs(file.stream, made, setting, costs);
    return output_close(&file, error);
}
