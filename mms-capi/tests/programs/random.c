/* Calls functions at random, with many wrong arguments: random [CALLS [SEED]]. No call may access memory that is
 * not its own, and each must return a correct code. Prints the number of calls, and of successful ones. */
#include "support.h"
#include <math.h>
#include <mms_capi.h>
#include <stdint.h>

enum { FIELDS = 3 };

static uint64_t state;
static mms_field *fields[FIELDS];
static mms_stop *stops[2]; /* the second is requested */
static unsigned long done, attempts;

/* SplitMix64 (Steele, Lea & Flood). */
static uint64_t any(void)
{
    uint64_t z = state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

static size_t below(size_t count)
{
    return (size_t)(any() % count);
}

/* True once in `times` on average. */
static int once_in(size_t times)
{
    return below(times) == 0;
}

static void wrong(const char *what)
{
    printf("call %lu of random.c: %s\n", attempts, what);
    exit(1);
}

/* The memory that the functions may access. */
struct text {
    char *first;
    size_t size;
};

static struct text copy(const char *text, size_t size)
{
    struct text made = {room(size), size};
    memcpy(made.first, text, size);
    return made;
}

enum kind { QUANTITY, PARAMETER, FACE, BOUND, ODD, NONE, LONGEST };

/* A name, mostly of the requested kind. */
static struct text a_name(const mms_field *field, enum kind kind)
{
    static const char *const bounds[] = {"lower", "upper", "inner", "outer", "theta", "time"};
    static const char *const odd[] = {"", "x", "rho", "\xC3\xA9", "\xFF", "b\xE2\x82", "%s%n", "a\nb"};
    size_t parameters = mms_field_parameter_count(field), faces = mms_field_face_count(field);
    struct text made = {NULL, 0};
    const char *name = "";
    switch (once_in(4) ? (enum kind)below(LONGEST + 1) : kind) {
    case QUANTITY: name = mms_quantity_name(below(mms_quantity_count())); break;
    case PARAMETER: name = parameters == 0 ? "" : mms_field_parameter_name(field, below(parameters)); break;
    case FACE: name = faces == 0 ? "" : mms_field_face_name(field, below(faces)); break;
    case BOUND: name = bounds[below(6)]; break;
    case ODD: name = odd[below(8)]; break;
    case NONE: return made;
    case LONGEST:
        made.size = 4097;
        made.first = memset(room(made.size), 'a', made.size);
        made.first[4096] = once_in(2) ? 0 : 'a';
        return made;
    }
    return copy(name, strlen(name) + 1);
}

static double a_number(void)
{
    static const double odd[] = {0, -0.0, 1, -1, 1e300, -1e300, 5e-324, 3.5, HUGE_VAL, NAN};
    return once_in(8) ? odd[below(10)] : (double)(any() >> 11) * 0x1p-53;
}

static size_t a_count(void)
{
    static const size_t odd[] = {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / 4, SIZE_MAX / 8, SIZE_MAX - 7};
    return once_in(16) ? odd[below(5)] : below(6);
}

/* An array of this number of numbers, or an invalid one. An invalid array has only one. */
static double *an_array(size_t count, double *other)
{
    size_t size = count > 1000 ? 1 : count;
    double *first = room(size * sizeof *first);
    for (size_t i = 0; i < size; ++i) {
        first[i] = a_number();
    }
    switch (below(24)) {
    case 0: return NULL;
    case 1: return (double *)(void *)((char *)first + 4);
    case 2: return other == NULL ? first : other;
    default: return first;
    }
}

static mms_field *a_field(void)
{
    mms_field *field = fields[below(FIELDS)];
    return !once_in(32) ? field : once_in(2) ? NULL : (mms_field *)(void *)((char *)field + 1);
}

/* Checks the results of a call. */
static void look(mms_code code, struct text message)
{
    done += code == MMS_CODE_OK;
    if (code < MMS_CODE_OK || code == MMS_CODE_DEFECT || code > MMS_CODE_STOPPED) {
        wrong(message.size > 0 ? message.first : "a code that there is not");
    }
    if (message.first == NULL || message.size == 0) {
        return;
    }
    size_t length = strnlen(message.first, message.size);
    if (length == message.size || !is_utf8(message.first, length)) {
        wrong("a message that is no text");
    }
    if (message.size > 8 && (length == 0) != (code == MMS_CODE_OK)) {
        wrong("a code and a message that contradict each other");
    }
}

/* A buffer: large, small, NULL, or the memory of an argument. */
static struct text a_message(struct text argument)
{
    struct text made = {NULL, below(64)};
    switch (below(8)) {
    case 0: return made;
    case 1: return argument;
    case 2: made.size = 1024; break;
    default: break;
    }
    made.first = room(made.size);
    return made;
}

static void make(void)
{
    static char text[sizeof cube_text];
    mms_field *field = NULL;
    struct text message = a_message(copy("bar_1d", 7)), name = a_name(fields[0], ODD);
    mms_code code;
    memcpy(text, cube_text, sizeof text);
    for (size_t count = below(3); count > 0; --count) {
        text[below(sizeof text - 1)] = (char)(1 + below(127));
    }
    if (once_in(4)) {
        code = mms_field_from_gallery(once_in(2) ? "bar_1d" : name.first, &field, message.first, message.size);
    } else {
        struct text toml = copy(text, sizeof text);
        const char *material = once_in(4) ? name.first : NULL;
        if (name.size > 0) {
            name.first[name.size - 1] = 0; /* the content of a file may be longer than a name */
        }
        code = mms_field_from_text("mine", toml.first, material, &field, message.first, message.size);
    }
    look(code, message);
    if ((code == MMS_CODE_OK) != (field != NULL)) {
        wrong("a field where there is none");
    }
    if (field != NULL) {
        size_t index = below(FIELDS);
        mms_field_free(fields[index]);
        fields[index] = field;
    }
}

static void set(void)
{
    mms_field *field = a_field();
    size_t count = a_count(), size = count > 1000 ? 1 : count;
    struct text one = a_name(field, PARAMETER), message = a_message(one);
    if (once_in(2)) {
        look(mms_field_set_parameter(field, one.first, a_number(), message.first, message.size), message);
        return;
    }
    const char **names = room(size * sizeof *names);
    for (size_t i = 0; i < size; ++i) {
        names[i] = a_name(field, PARAMETER).first;
    }
    look(mms_field_set_parameters(field, count, names, an_array(count, NULL), message.first, message.size), message);
}

/* The functions with few results. */
static void ask(void)
{
    static const enum kind kinds[] = {PARAMETER, QUANTITY, BOUND, BOUND, BOUND};
    mms_field *field = a_field();
    size_t function = below(5), size = below(5), *components = room(sizeof *components);
    struct text name = a_name(field, kinds[function]), message = a_message(name);
    double *values = an_array(function == 0 ? 1 : function == 3 ? 3 : size, NULL);
    char *text = message.first;
    mms_code code;
    switch (function) {
    case 0: code = mms_field_get_parameter(field, name.first, values, text, message.size); break;
    case 1: code = mms_field_components(field, name.first, components, text, message.size); break;
    case 2: code = mms_field_bound_components(field, name.first, components, text, message.size); break;
    case 3: code = mms_field_bound(field, name.first, values, text, message.size); break;
    default: code = mms_field_get_bound(field, name.first, size, values, text, message.size);
    }
    look(code, message);
}

static void evaluate(void)
{
    mms_field *field = a_field();
    size_t count = a_count(), dimension = mms_field_dimension(field), components = 9;
    struct text name = a_name(field, QUANTITY), message;
    if (mms_field_components(field, name.first, &components, NULL, 0) != MMS_CODE_OK) {
        components = 1;
    }
    if (count > 1000) {
        dimension = components = 1;
    }
    double *points = an_array(count * dimension, NULL);
    double *normals = once_in(2) ? NULL : an_array(count * dimension, NULL);
    double *values = an_array(count * components, points);
    message = a_message(name);
    const mms_stop *stop = once_in(2) ? NULL : stops[once_in(8)];
    mms_code code = mms_field_evaluate_stoppable(field, name.first, a_number(), count, points, normals, stop,
                                                 values, message.first, message.size);
    look(code, message);
    if (code == MMS_CODE_STOPPED && stop != stops[1]) {
        wrong("stopped though nobody asked");
    }
    for (size_t i = 0; code == MMS_CODE_OK && i < count * components; ++i) {
        if (!isfinite(values[i])) {
            wrong("a value that is not finite");
        }
    }
}

static void normals(void)
{
    mms_field *field = a_field();
    size_t count = a_count(), dimension = count > 1000 ? 1 : mms_field_dimension(field);
    struct text name = a_name(field, FACE), message = a_message(name);
    double *points = an_array(count * dimension, NULL);
    look(mms_field_normals(field, name.first, count, points, an_array(count * dimension, points), message.first,
                           message.size), message);
}

int main(int arguments, char **argument)
{
    unsigned long calls = arguments > 1 ? strtoul(argument[1], NULL, 10) : 2000;
    state = arguments > 2 ? strtoull(argument[2], NULL, 10) : 1;
    mms_field_from_gallery("bar_1d", &fields[0], NULL, 0);
    mms_field_from_text("ring", ring_text, NULL, &fields[1], NULL, 0);
    mms_field_from_text("cube", cube_text, NULL, &fields[2], NULL, 0);
    stops[0] = mms_stop_new();
    stops[1] = mms_stop_new();
    mms_stop_request(stops[1]);
    for (attempts = 1; attempts <= calls; ++attempts) {
        size_t kind = below(256);
        if (kind == 0) {
            make();
        } else if (kind < 32) {
            set();
        } else if (kind < 96) {
            ask();
        } else if (kind < 128) {
            normals();
        } else {
            evaluate();
        }
        give_back(0);
    }
    for (int i = 0; i < FIELDS; ++i) {
        mms_field_free(fields[i]);
    }
    mms_stop_free(stops[0]);
    mms_stop_free(stops[1]);
    printf("%lu calls, %lu did what they are for\n", calls, done);
    return done * 4 < calls;
}
