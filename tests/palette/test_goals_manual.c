/* SPDX-License-Identifier: BSD-3-Clause
 * The examples of docs/design.md are read as they stand. */
#include <stdio.h>

#include "base/file.h"
#include "palette/goals_document.h"

/* The text of the one block of JSON behind "<!-- test: KIND -->". */
static char *example(const char *kind) {
    static const char fence[] = "```json\n";
    char *manual = NULL;
    char mark[64];
    size_t byte_count = 0;
    mtm_error error;
    assert_ok(mtm_file_read(METAMER_SOURCE_DIR "/docs/design.md", 1 << 20, &manual, &byte_count, &error),
              error);
    (void)snprintf(mark, sizeof mark, "<!-- test: %s -->\n%s", kind, fence);
    const char *begin = strstr(manual, mark);
    assert_non_null(begin);
    begin += strlen(mark);
    assert_null(strstr(begin, mark));
    char *end = strstr(begin, "\n```");
    assert_non_null(end);
    end[1] = '\0';
    char *text = strdup(begin);
    assert_non_null(text);
    free(manual);
    return text;
}

static void the_example_has_every_kind_of_row(void **state) {
    (void)state;
    char *text = example("goals");
    mtm_goals *goals = goals_parse(text);
    assert_int_equal(goals->palette.material_count, 4);
    assert_int_equal(goals->palette.light_count, 3);
    assert_int_equal(goals->goal_count, 8);
    static const char *const keys[] = {"srgb", "lab", "xyz", "black", "same_as", "differs_from", "recipe"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        char quoted[32];
        (void)snprintf(quoted, sizeof quoted, "\"%s\":", keys[i]);
        assert_non_null(strstr(text, quoted));
    }
    mtm_goals_destroy(goals);
    free(text);
}

/* Each line alone is a document, but for that of a library, which has no goals of its own. */
static void every_recipe_has_an_example_that_is_a_document(void **state) {
    (void)state;
    int count = 0;
    char *lines = example("recipes");
    for (char *line = strtok(lines, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        char text[1024];
        const bool is_library = strstr(line, "from_library") != NULL;
        (void)snprintf(text, sizeof text, "{\"goals\": [%s%s]}", line,
                       is_library ? ", {\"recipe\": \"figure 7\"}" : "");
        mtm_goals *goals = goals_parse(text);
        assert_int_equal(goals->search_count, is_library ? 1 : 0);
        mtm_goals_destroy(goals);
        count++;
    }
    assert_int_equal(count, 9);
    free(lines);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_example_has_every_kind_of_row),
        cmocka_unit_test(every_recipe_has_an_example_that_is_a_document),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
