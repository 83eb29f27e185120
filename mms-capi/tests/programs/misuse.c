/* Every kind of wrong argument that a function can detect, each with its code, and arguments that are allowed
 * though they look wrong. Prints the number of calls. */
#include "support.h"
#include <mms_capi.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <sys/resource.h>
#include <time.h>

static int calls;
static char message[65536];
static mms_field *bar, *ring, *cube;

/* Ends the program if a call returned another code, or its message lacks some words. */
static void expect(int line, mms_code expected, const char *words, mms_code code, const char *said)
{
    ++calls;
    if (code != expected || strstr(said, words) == NULL || (code == MMS_CODE_OK) != (*said == 0)) {
        printf("misuse.c:%d: code %d, expected %d: %s\n", line, (int)code, (int)expected, said);
        exit(1);
    }
}

/* Ends the program if a condition is false. */
static void must(int line, int holds)
{
    if (!holds) {
        printf("misuse.c:%d: what is tested here does not hold\n", line);
        exit(1);
    }
}

#define MUST(holds) must(__LINE__, holds)
#define SAYS(code, words, said, call) expect(__LINE__, code, words, call, said)
#define REFUSED(code, words, function, ...) \
    SAYS(code, words, message, function(__VA_ARGS__, message, sizeof message))
#define OK(function, ...) REFUSED(MMS_CODE_OK, "", function, __VA_ARGS__)
#define WRONG(words, function, ...) REFUSED(MMS_CODE_INVALID_ARGUMENT, words, function, __VA_ARGS__)

/* Numbers at the end of their memory. */
static double *numbers(size_t count, double value)
{
    double *first = room(count * sizeof *first);
    for (size_t i = 0; i < count; ++i) {
        first[i] = value;
    }
    return first;
}

/* This number of letters, without a NUL after the last. */
static char *letters(size_t count)
{
    return memset(room(count), 'a', count);
}

/* A pointer into an element. */
static void *askew(void *pointer)
{
    return (char *)pointer + 1;
}

static void counts_that_no_array_has(void)
{
    double *points = numbers(6, 0.1), *values = room(18 * sizeof *values);
    const char *names[] = {"rho0"};
    size_t counts[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / 8, SIZE_MAX / 8 + 1, SIZE_MAX / 16 + 1,
                       SIZE_MAX / 24 + 2, SIZE_MAX / 72 + 1};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
        size_t count = counts[i];
        WRONG("`count`", mms_field_evaluate, cube, "P", 0.1, count, points, NULL, values);
        if (count > SIZE_MAX / 48) {
            WRONG("`count`", mms_field_normals, cube, "x_max", count, points, values);
        }
        if (count > SIZE_MAX / 16) {
            WRONG("`count`", mms_field_set_parameters, bar, count, names, points);
        }
    }
}

/* Names are only read until one is found twice. */
static void more_settings_than_parameters(void)
{
    size_t enough = mms_field_parameter_count(bar) + 1;
    const char **names = room(enough * sizeof *names);
    for (size_t i = 0; i < enough; ++i) {
        names[i] = mms_field_parameter_name(bar, i % (enough - 1));
    }
    double *values = numbers(enough, 1);
    REFUSED(MMS_CODE_INVALID_PARAMETER, "twice", mms_field_set_parameters, bar, SIZE_MAX / 16, names, values);
    names[1] = NULL;
    WRONG("`names[1]` is NULL", mms_field_set_parameters, bar, enough, names, values);
    OK(mms_field_set_parameters, bar, 0, NULL, NULL);
}

static void pointers_out_of_line(void)
{
    double *points = numbers(3, 0.1), *values = numbers(18, 0), *normals = numbers(6, 0);
    const char *names[2] = {"rho0", "rho0"};
    size_t components[2];
    mms_field *place[2];
    WRONG("`field` is not aligned", mms_field_from_gallery, "bar_1d", askew(place));
    WRONG("`field` is not aligned", mms_field_components, askew(bar), "b", components);
    WRONG("`components` is not aligned", mms_field_components, bar, "b", askew(components));
    WRONG("`value` is not aligned", mms_field_get_parameter, bar, "rho0", askew(values));
    WRONG("`names` is not aligned", mms_field_set_parameters, bar, 1, askew(names), values);
    WRONG("`values` is not aligned", mms_field_set_parameters, bar, 1, names, askew(values));
    WRONG("`points` is not aligned", mms_field_evaluate, bar, "b", 0, 1, askew(points), NULL, values);
    WRONG("`normals` is not aligned", mms_field_evaluate, bar, "traction", 0, 1, points, askew(normals), values);
    WRONG("`values` is not aligned", mms_field_evaluate, bar, "b", 0, 1, points, NULL, askew(values));
    WRONG("`points` is not aligned", mms_field_normals, bar, "x_max", 1, askew(points), normals);
    WRONG("`normals` is not aligned", mms_field_normals, bar, "x_max", 1, points, askew(normals));
    WRONG("`values` is not aligned", mms_field_bound, bar, "time", askew(values));
    WRONG("`values` is not aligned", mms_field_get_bound, bar, "time", 2, askew(values));
    WRONG("`components` is not aligned", mms_field_bound_components, bar, "time", askew(components));
    MUST(mms_field_dimension(askew(bar)) == 0 && mms_field_name(askew(bar)) == NULL);
    mms_field_free(askew(bar));
}

static void results_over_arguments(void)
{
    union {
        double numbers[32];
        size_t size;
        mms_field *field;
        char text[256];
    } all = {{0.25, 0.5, 0.75, 1}};
    double *points = all.numbers, away[8];
    WRONG("`values` overlaps with `points`", mms_field_evaluate, bar, "b", 0, 4, points, NULL, points);
    WRONG("`values` overlaps with `points`", mms_field_evaluate, bar, "b", 0, 4, points, NULL, points + 3);
    WRONG("`values` overlaps with `points`", mms_field_evaluate, bar, "b", 0, 4, points + 3, NULL, points);
    OK(mms_field_evaluate, bar, "b", 0, 4, points, NULL, points + 4);
    for (int i = 0; i < 4; ++i) {
        away[i] = 1;
    }
    WRONG("`values` overlaps with `normals`", mms_field_evaluate, bar, "traction", 0, 4, points, away, away + 2);
    WRONG("`normals` overlaps with `points`", mms_field_normals, bar, "x_max", 4, points, points + 1);
    strcpy(all.text + 64, "body_force");
    WRONG("`values` overlaps with `quantity`", mms_field_evaluate, bar, all.text + 64, 0, 4, away, NULL, points + 8);
    strcpy(all.text + 64, "x_max");
    WRONG("`normals` overlaps with `face`", mms_field_normals, bar, all.text + 64, 4, away, points + 8);

#define OVER_MESSAGE(what, call) \
    SAYS(MMS_CODE_INVALID_ARGUMENT, "`" what "` overlaps with `message`", all.text, call)
    OVER_MESSAGE("field", mms_field_from_gallery("bar_1d", &all.field, all.text, 256));
    OVER_MESSAGE("value", mms_field_get_parameter(bar, "rho0", points + 31, all.text, 256));
    OVER_MESSAGE("components", mms_field_components(bar, "b", &all.size, all.text, 256));
    OVER_MESSAGE("components", mms_field_bound_components(bar, "time", &all.size, all.text, 256));
    OVER_MESSAGE("values", mms_field_bound(bar, "time", points + 31, all.text, 256));
    OVER_MESSAGE("values", mms_field_get_bound(bar, "time", 2, points + 30, all.text, 256));
    OVER_MESSAGE("values", mms_field_evaluate(bar, "b", 0, 4, away, NULL, points, all.text, 256));
    OVER_MESSAGE("normals", mms_field_normals(bar, "x_max", 4, away, points, all.text, 256));
}

/* The message is written last. */
static void messages_over_arguments(void)
{
    char text[1 << 14] = "bar_2d";
    mms_field *field = NULL;
    SAYS(MMS_CODE_UNKNOWN_NAME, "no field `bar_2d`", text, mms_field_from_gallery(text, &field, text, 1024));
    strcpy(text, "uniform_stretch");
    SAYS(MMS_CODE_OK, "", text, mms_field_from_gallery(text, &field, text, sizeof text));
    mms_field_free(field);
    strcpy(text, "[field]\n");
    SAYS(MMS_CODE_INVALID_FIELD, "mine.toml", text,
         mms_field_from_text("mine", text, NULL, &field, text, sizeof text));
    strcpy(text, "amplitude");
    SAYS(MMS_CODE_OK, "", text + 4, mms_field_set_parameter(bar, text, 0.1, text + 4, 64));
    union {
        double points[2];
        char text[16];
    } both = {{0.5, 6}};
    double values[2];
    SAYS(MMS_CODE_NOT_FINITE, "body_force of `", both.text,
         mms_field_evaluate(bar, "b", 0, 2, both.points, NULL, values, both.text, 16));
    OK(mms_field_set_parameter, bar, "amplitude", 0.2);
    /* A capacity larger than any buffer means unlimited. */
    SAYS(MMS_CODE_UNKNOWN_NAME, "no parameter `x`", text, mms_field_get_parameter(bar, "x", values, text, SIZE_MAX));
}

/* Each text in turn is invalid. */
static void texts_that_are_none(void)
{
    double *values = numbers(9, 0.1);
    size_t components;
    mms_field *field;
    const char *name = memcpy(room(3), "\xC3(", 3);
    const char *cut = memcpy(room(5), "ab\xF0\x9F", 5);
    const char *texts[] = {name, cut, NULL};
    for (int i = 0; i < 3; ++i) {
        const char *text = texts[i], *words = text == NULL ? "is NULL" : "is not UTF-8";
        WRONG(words, mms_field_from_gallery, text, &field);
        WRONG(words, mms_field_from_text, text, "", NULL, &field);
        WRONG(words, mms_field_from_text, "mine", text, NULL, &field);
        if (text != NULL) {
            WRONG(words, mms_field_from_text, "mine", "", text, &field);
        }
        WRONG(words, mms_field_get_parameter, bar, text, values);
        WRONG(words, mms_field_set_parameter, bar, text, 1);
        WRONG(words, mms_field_set_parameters, bar, 1, &text, values);
        WRONG(words, mms_field_components, bar, text, &components);
        WRONG(words, mms_field_evaluate, bar, text, 0, 1, values, NULL, values + 4);
        WRONG(words, mms_field_normals, bar, text, 1, values, values + 4);
        WRONG(words, mms_field_bound, bar, text, values);
        WRONG(words, mms_field_get_bound, bar, text, 3, values);
        WRONG(words, mms_field_bound_components, bar, text, &components);
    }
}

/* No byte is read beyond the one that exceeds the limit. */
static void texts_without_an_end(void)
{
    double value;
    mms_field *field;
    const char *name = letters(4097), *content = letters((1 << 20) + 1);
    REFUSED(MMS_CODE_UNKNOWN_NAME, "more than 4096 bytes", mms_field_from_gallery, name, &field);
    REFUSED(MMS_CODE_UNKNOWN_NAME, "more than 4096 bytes", mms_field_get_parameter, bar, name, &value);
    WRONG("`name` has more than 4096 bytes", mms_field_from_text, name, "", NULL, &field);
    REFUSED(MMS_CODE_INVALID_FIELD, "`toml` has more than 1048576", mms_field_from_text, "mine", content, NULL, &field);
    REFUSED(MMS_CODE_INVALID_FIELD, "`material` has more", mms_field_from_text, "mine", "", content, &field);
    MUST(field == NULL);
}

static void bounds_and_their_room(void)
{
    const struct {
        mms_field *field;
        const char *name;
        size_t components;
    } bounds[] = {{bar, "lower", 1}, {bar, "time", 2}, {ring, "outer", 1}, {ring, "theta", 2}, {cube, "upper", 3}};
    for (int i = 0; i < 5; ++i) {
        size_t components = 0;
        OK(mms_field_bound_components, bounds[i].field, bounds[i].name, &components);
        MUST(components == bounds[i].components);
        for (size_t count = 0; count <= 4; ++count) {
            double *values = room(count * sizeof *values);
            if (count < components) {
                WRONG("`room` is", mms_field_get_bound, bounds[i].field, bounds[i].name, count, values);
            } else {
                OK(mms_field_get_bound, bounds[i].field, bounds[i].name, count, values);
                OK(mms_field_bound, bounds[i].field, bounds[i].name, values);
            }
        }
        WRONG("`values` is NULL", mms_field_get_bound, bounds[i].field, bounds[i].name, 3, NULL);
    }
    double values[3];
    REFUSED(MMS_CODE_UNKNOWN_NAME, "this body has lower", mms_field_get_bound, bar, "inner", 3, values);
}

/* For every capacity, a message is a beginning of the whole one, and ends between characters. */
static void capacities_of_messages(void)
{
    const char *name = "\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80";
    double value;
    REFUSED(MMS_CODE_UNKNOWN_NAME, name, mms_field_get_parameter, bar, name, &value);
    size_t whole = strlen(message), cut = 0;
    for (size_t capacity = 0; capacity <= whole + 2; ++capacity) {
        size_t before = room_count;
        char *buffer = room(capacity);
        MUST(mms_field_get_parameter(bar, name, &value, buffer, capacity) == MMS_CODE_UNKNOWN_NAME);
        if (capacity > 0) {
            size_t length = strnlen(buffer, capacity), most = capacity - 1 < whole ? capacity - 1 : whole;
            MUST(length <= most && length + 3 >= most);
            MUST(is_utf8(buffer, length) && memcmp(buffer, message, length) == 0);
            cut += length < most;
        }
        give_back(before);
    }
    MUST(cut == 1 + 2 + 3);
    MUST(mms_field_get_parameter(bar, name, &value, NULL, 64) == MMS_CODE_UNKNOWN_NAME);
}

/* All calls of a program, on the smallest allowed stack. */
static void *on_a_small_stack(void *toml)
{
    double points[3] = {0.1, 0.2, 0.3}, normals[3] = {1, 0, 0}, values[9];
    mms_field *field;
    size_t components;
    REFUSED(MMS_CODE_INVALID_FIELD, "mine.toml", mms_field_from_text, "mine", toml, NULL, &field);
    OK(mms_field_from_text, "cube", cube_text, NULL, &field);
    for (size_t i = 0; i < mms_quantity_count(); ++i) {
        OK(mms_field_components, field, mms_quantity_name(i), &components);
        OK(mms_field_evaluate, field, mms_quantity_name(i), 0.1, 1, points, normals, values);
    }
    points[0] = 3.5;
    REFUSED(MMS_CODE_NOT_FINITE, "point 0", mms_field_evaluate, bar, "b", 0, 1, points, NULL, values);
    for (size_t i = 0; i < mms_field_parameter_count(field); ++i) {
        OK(mms_field_get_parameter, field, mms_field_parameter_name(field, i), values);
        OK(mms_field_set_parameter, field, mms_field_parameter_name(field, i), values[0]);
    }
    REFUSED(MMS_CODE_INVALID_PARAMETER, "density", mms_field_set_parameter, field, "rho0", -1);
    REFUSED(MMS_CODE_UNKNOWN_NAME, "did you mean", mms_field_set_parameter, field, "rho", 1);
    OK(mms_field_get_bound, field, "upper", 3, values);
    OK(mms_field_normals, field, "x_max", 1, values, normals);
    mms_field_free(field);
    return NULL;
}

static void a_small_stack(void)
{
    /* The deepest nesting that TOML's parser accepts. */
    char toml[512] = "";
    for (int i = 0; i < 75; ++i) {
        strcat(toml, i == 0 ? "a = " : "{a = ");
    }
    strcat(toml, "1");
    memset(toml + strlen(toml), '}', 74);
    size_t size = 64 << 10;
    pthread_attr_t attributes;
    pthread_t thread;
    int failed = pthread_attr_init(&attributes);
    failed |= pthread_attr_setstacksize(&attributes, size);
    failed |= pthread_create(&thread, &attributes, on_a_small_stack, toml);
    failed |= pthread_join(thread, NULL);
    MUST(!failed);
}

/* The text of a field that takes seconds to make; a faster one where seconds would be minutes. */
static char *long_text(void)
{
#ifdef HEAP
    return strcpy(room(sizeof cube_text), cube_text);
#else
    const char *end = strstr(cube_text, "rate*X*t^2"), *rest = end + strlen("rate*X*t^2");
    char *text = room(1 << 17), *next = text + sprintf(text, "%.*s1e-6*(X", (int)(end - cube_text), cube_text);
    for (int k = 1; k <= 400; ++k) {
        next += sprintf(next, " + sin(%d*X + t)*cos(%d*Y)/(3 + sin(%d*t + Z))", k, 2 * k + 1, k);
    }
    sprintf(next, ")%s", rest);
    return text;
#endif
}

static mms_stop *stop;
static clock_t requested_at;

static void *request_soon(void *unused)
{
    usleep(100000);
    requested_at = clock();
    mms_stop_request(stop);
    return unused;
}

static void request_in_handler(int number)
{
    (void)number;
    mms_stop_request(stop);
}

/* After a request to stop, a running call ends soon, and later calls do not begin. */
static void work_that_is_stopped(void)
{
    enum { COUNT = 20000 };
    double *points = numbers(COUNT, 0.5), *values = numbers(COUNT, 7);
    char *text = long_text();
    mms_field *field, *early;
    OK(mms_field_from_text_stoppable, "cube", cube_text, NULL, NULL, &early);
    mms_field_free(early);
    stop = mms_stop_new();
    MUST(stop != NULL && mms_stop_is_requested(stop) == 0);
    OK(mms_field_from_text_stoppable, "cube", cube_text, NULL, stop, &early);
    OK(mms_field_evaluate_stoppable, bar, "b", 0, COUNT, points, NULL, stop, values);
    WRONG("`stop` is not aligned", mms_field_from_text_stoppable, "cube", cube_text, NULL, askew(stop), &field);
    WRONG("`stop` is not aligned", mms_field_evaluate_stoppable, bar, "b", 0, 1, points, NULL, askew(stop), values);
    for (int work = 0; work < 2; ++work) {
        pthread_t thread;
        mms_code code = MMS_CODE_OK;
        MUST(pthread_create(&thread, NULL, request_soon, NULL) == 0);
        while (code == MMS_CODE_OK && work == 0) {
            code = mms_field_from_text_stoppable("cube", text, NULL, stop, &field, message, sizeof message);
            mms_field_free(field);
        }
        while (code == MMS_CODE_OK && work == 1) {
            code = mms_field_evaluate_stoppable(bar, "b", 0, COUNT, points, NULL, stop, values, message,
                                                sizeof message);
        }
        SAYS(MMS_CODE_STOPPED, "as was requested", message, code);
        MUST(pthread_join(thread, NULL) == 0);
        printf("%.3f s from the request to the end\n", (double)(clock() - requested_at) / CLOCKS_PER_SEC);
        MUST(clock() - requested_at < 3 * CLOCKS_PER_SEC);
        MUST(mms_stop_is_requested(stop) == 1);
        REFUSED(MMS_CODE_STOPPED, "", mms_field_from_text_stoppable, "cube", cube_text, NULL, stop, &field);
        MUST(field == NULL);
        values[0] = 7;
        REFUSED(MMS_CODE_STOPPED, "", mms_field_evaluate_stoppable, bar, "b", 0, 1, points, NULL, stop, values);
        MUST(values[0] == 7);
        mms_stop_free(stop);
        stop = mms_stop_new();
    }
    /* A field made before is unchanged. */
    OK(mms_field_set_parameter, early, "rho0", 7);
    OK(mms_field_evaluate, early, "mass_density", 0, 1, points, NULL, values);
    mms_field_free(early);
    signal(SIGUSR1, request_in_handler);
    raise(SIGUSR1);
    MUST(mms_stop_is_requested(stop) == 1);
    mms_stop_free(stop);
    mms_stop_request(NULL);
    MUST(mms_stop_is_requested(NULL) == 0);
    mms_stop_free(NULL);
}

/* If the system provides no thread, a code says so. Runs first, since the stacks of ended threads are kept. */
static void no_thread(void)
{
#ifndef HEAP
    unsigned long pages = 0;
    FILE *self = fopen("/proc/self/statm", "r");
    if (self == NULL || fscanf(self, "%lu", &pages) != 1) {
        return;
    }
    fclose(self);
    struct rlimit old, less;
    getrlimit(RLIMIT_AS, &old);
    less = old;
    less.rlim_cur = pages * (unsigned long)sysconf(_SC_PAGESIZE) + (1 << 20);
    setrlimit(RLIMIT_AS, &less);
    mms_field *field = (mms_field *)&less;
    REFUSED(MMS_CODE_NO_THREAD, "no thread", mms_field_from_gallery, "bar_1d", &field);
    setrlimit(RLIMIT_AS, &old);
    MUST(field == NULL);
#endif
}

int main(void)
{
    no_thread();
    OK(mms_field_from_gallery, "bar_1d", &bar);
    OK(mms_field_from_text, "ring", ring_text, NULL, &ring);
    OK(mms_field_from_text, "cube", cube_text, NULL, &cube);
    void (*const tests[])(void) = {
        counts_that_no_array_has, more_settings_than_parameters, pointers_out_of_line,
        results_over_arguments, messages_over_arguments, texts_that_are_none, texts_without_an_end,
        bounds_and_their_room, capacities_of_messages, a_small_stack, work_that_is_stopped,
    };
    for (size_t i = 0; i < sizeof tests / sizeof *tests; ++i) {
        tests[i]();
        give_back(0);
    }
    mms_field_free(bar);
    mms_field_free(ring);
    mms_field_free(cube);
    mms_field_free(NULL);
    printf("%d calls\n", calls);
    return 0;
}
