/* SPDX-License-Identifier: BSD-3-Clause */
#include "base/json.h"

#include <stdlib.h>

#include "fixture.h"

static json_t *parse(const char *text) {
    mtm_error error;
    json_t *value = NULL;
    assert_ok(mtm_json_parse("d.json", text, strlen(text), &value, &error), error);
    return value;
}

static void the_first_failure_sticks_and_names_its_place(void **state) {
    (void)state;
    static const char *const keys[] = {"size", "name"};
    mtm_error error;
    double size = 7;
    json_t *document = parse("{\"list\": [{\"size\": -3, \"name\": 5}]}");
    mtm_json_reader reader = mtm_json_begin("d.json", &error);
    (void)mtm_json_enter(&reader, "list");
    (void)mtm_json_enter_index(&reader, 0);
    const json_t *object = json_array_get(json_object_get(document, "list"), 0);
    assert_true(mtm_json_expect_object(&reader, object, keys, 2));
    assert_false(mtm_json_number(&reader, object, "size", mtm_json_not_negative, &size));
    assert_int_equal(reader.status, MTM_FORMAT);
    assert_string_equal(error.message, "d.json: list[0].size is -3, must be a number, 0 or more");
    const char *name = NULL;
    assert_false(mtm_json_text(&reader, object, "name", &name));
    assert_non_null(strstr(error.message, "size"));
    assert_near(size, 7, 0);
    json_decref(document);
}

static void syntax_errors_and_double_keys_name_the_line(void **state) {
    (void)state;
    mtm_error error;
    json_t *value = NULL;
    assert_fails(mtm_json_parse("d.json", "{\n\"a\": 1,\n}", 11, &value, &error), MTM_FORMAT, error,
                 "d.json:3");
    assert_fails(mtm_json_parse("d.json", "{\"a\": 1, \"a\": 2}", 16, &value, &error), MTM_FORMAT, error,
                 "a");
    assert_fails(mtm_json_parse("d.json", "", 0, &value, &error), MTM_FORMAT, error, "d.json");
}

static void deep_nesting_is_refused_not_followed(void **state) {
    (void)state;
    mtm_error error;
    json_t *value = NULL;
    char text[100000];
    memset(text, '[', sizeof text);
    assert_fails(mtm_json_parse("d.json", text, sizeof text, &value, &error), MTM_FORMAT, error, "d.json");
}

static void written_documents_read_back_exactly(void **state) {
    (void)state;
    json_t *document =
        parse("{\"z\": [0.1, 1e-300, 123456789.123456789, -0.5], \"a\": {\"text\": \"q\\\"\\u00e4\\n\"},"
              " \"e\": [], \"o\": {}, \"n\": null, \"t\": true, \"i\": 12345678901}");
    for (int is_indented = 0; is_indented < 2; is_indented++) {
        char *text = mtm_json_format(document, is_indented == 1);
        assert_non_null(strstr(text, is_indented == 1 ? "[0.1, 1e-300, " : "[0.1,1e-300,"));
        json_t *again = parse(text);
        assert_true(json_equal(document, again) == 1);
        json_decref(again);
        free(text);
    }
    json_decref(document);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_failure_sticks_and_names_its_place),
        cmocka_unit_test(syntax_errors_and_double_keys_name_the_line),
        cmocka_unit_test(deep_nesting_is_refused_not_followed),
        cmocka_unit_test(written_documents_read_back_exactly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
