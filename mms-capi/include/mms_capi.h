/* Manufactured solutions for solid mechanics: any field, any quantity, in batches.
 *
 * Names and texts are UTF-8 and end with a NUL; a name has at most 4096 bytes, the content of a file
 * 1 MiB, and no byte beyond is read. Numbers are double, angles radians, units those of
 * the field, SI in the gallery. D is the dimension of a field.
 *
 * Functions that can fail return a code, and take a buffer `message` of `capacity` bytes, for what is
 * wrong: a text that ends with a NUL, cut between characters where there is no room for all of it, empty if
 * nothing is wrong. NULL is allowed where no message is wanted; 1024 bytes are enough but for the mistakes of a
 * field file. The message is written last: it may stand where an argument stood.
 *
 * What can be seen of a pointer is looked at before anything is made of it. One that is needed and is NULL, one
 * that is not aligned for its type, a count that no array has, results that overlap with arguments or the
 * message, and a text that is not UTF-8, are MMS_CODE_INVALID_ARGUMENT. What results are written to need not be
 * initialised, and nothing but results is written to it; after a failure it holds anything, but for what is said
 * to be NULL. Not to be seen is whether memory of the stated size is there and stays as it is during the call, and
 * whether a field is one that was made and not freed: that is the caller's. Arrays of no elements may be NULL.
 *
 * There is no global state. Any function may be called on any thread at any time, also on one field:
 * an evaluation has the parameters of the moment at which it starts. Only mms_field_free must come
 * after all else. No panic leaves the library: it becomes MMS_CODE_DEFECT.
 *
 * A field from a text may take seconds to make, and an evaluation as long as there are points. The functions whose
 * names end with _stoppable do the same as those without, until somebody requests to stop: from another
 * thread, or in a signal handler. All else takes about a second at most, or stops where points are passed in parts.
 *
 * Two things end the program, as abort() does: memory that the system does not have, and a stack that is too
 * small. Making a field takes at most 128 MiB of memory while it lasts, all else little, however many points there
 * are. Making a field runs on a thread of its own with a stack of 2 MiB, which ends before the call
 * does; if the system gives none, that is MMS_CODE_NO_THREAD. All else runs on the thread of the caller, for which
 * a stack of 64 KiB is enough. Rounding must be to nearest, and floating-point exceptions masked, as they are when
 * a program starts.
 *
 * Values are those of `mms eval`, bit for bit. They are interpreted: a point takes less than a
 * microsecond, and the points of a call share what needs only the parameters and the time. Where that
 * counts, embed the code that `mms emit` writes.
 *
 * Before version 1, each minor version has an interface of its own. Within one, functions and codes are only added:
 * take a code that you do not know for a failure.
 */


#ifndef MMS_CAPI_H
#define MMS_CAPI_H

/* Made of mms-capi/src/abi.rs: MMS_BLESS=1 cargo test -p mms-capi --test suite header */

#include <stddef.h>
#include <stdint.h>

// How a call went.
enum mms_code
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // It did what it is for.
  MMS_CODE_OK = 0,
  // A pointer that is NULL or not aligned, a count that no array has, too little room, results that overlap with
  // something, a text that is not UTF-8, a time or a point that is not finite, a normal that is missing or not a
  // unit vector.
  MMS_CODE_INVALID_ARGUMENT = 1,
  // No field, parameter, quantity, face or bound has that name.
  MMS_CODE_UNKNOWN_NAME = 2,
  // The text of a field or of its material has mistakes; the message shows each at its line and
  // column.
  MMS_CODE_INVALID_FIELD = 3,
  // A value that the field does not allow: outside its range, or one that leaves no body, no time
  // window or no positive density.
  MMS_CODE_INVALID_PARAMETER = 4,
  // A value that is not defined at a point, or is beyond the range of a double.
  MMS_CODE_NOT_FINITE = 5,
  // A mistake of this library.
  MMS_CODE_DEFECT = 6,
  // The system gives no thread. Making a field takes one, with a stack of 2 MiB.
  MMS_CODE_NO_THREAD = 7,
  // Somebody requested to stop, and nothing was made.
  MMS_CODE_STOPPED = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum mms_code mms_code;
#else
typedef int32_t mms_code;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A field and the values of its parameters.
typedef struct mms_field mms_field;

// By which calls are told to stop.
typedef struct mms_stop mms_stop;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The version of the library, such as "0.1.0".
const char *mms_version(void);

// How many fields the gallery has.
size_t mms_gallery_size(void);

// The name of a field of the gallery; NULL from `mms_gallery_size()` on. Names are in alphabetical
// order, and are never freed.
const char *mms_gallery_name(size_t index);

// How many quantities every field has.
size_t mms_quantity_count(void);

// The name of a quantity, such as "body_force"; NULL from `mms_quantity_count()` on. Names are never
// freed.
const char *mms_quantity_name(size_t index);

// Makes `*field` the field of that name of the gallery.
//
// Codes: MMS_CODE_UNKNOWN_NAME. On failure `*field` is NULL.
mms_code mms_field_from_gallery(const char *name,
                                struct mms_field **field,
                                char *message,
                                size_t capacity);

// Makes `*field` the field of a text, the content of a field file. `name` is what
// messages call it. `material` is the content of the material file that the field names, as in
// `model = "./mine.toml"`, or NULL where it names a material that ships.
//
// Codes: MMS_CODE_INVALID_FIELD, with every mistake at its line and column. On failure `*field` is NULL.
mms_code mms_field_from_text(const char *name,
                             const char *toml,
                             const char *material,
                             struct mms_field **field,
                             char *message,
                             size_t capacity);

// The same as `mms_field_from_text`, until somebody requests to stop. NULL for `stop` means that nobody will.
//
// Codes: MMS_CODE_INVALID_FIELD, MMS_CODE_STOPPED. On failure `*field` is NULL.
mms_code mms_field_from_text_stoppable(const char *name,
                                       const char *toml,
                                       const char *material,
                                       const struct mms_stop *stop,
                                       struct mms_field **field,
                                       char *message,
                                       size_t capacity);

// Makes what a program requests to stop with, by which calls of its are told to. It is never NULL.
struct mms_stop *mms_stop_new(void);

// Requests that calls to which `stop` was passed, now or later, end soon: within milliseconds, or some hundred of
// them where a formula is large. There is no way back; the next work gets a new one. Any thread may call
// this at any time, and so may a signal handler. NULL is allowed.
void mms_stop_request(const struct mms_stop *stop);

// Whether somebody requested to stop: 1 or 0; 0 for NULL. A signal handler may call this, too.
int mms_stop_is_requested(const struct mms_stop *stop);

// Frees it, when all calls to which it was passed have ended. NULL is allowed.
void mms_stop_free(struct mms_stop *stop);

// Frees a field, and what its functions returned. NULL is allowed. No other call may be at work on
// the field.
void mms_field_free(struct mms_field *field);

// The name of a field; NULL for NULL. It lives as long as the field, as do all texts of a field.
const char *mms_field_name(const struct mms_field *field);

// The title of a field, a sentence; NULL for NULL.
const char *mms_field_title(const struct mms_field *field);

// D, the number of coordinates of a point: 1, 2 or 3; 0 for NULL.
size_t mms_field_dimension(const struct mms_field *field);

// How many parameters a field has; 0 for NULL.
size_t mms_field_parameter_count(const struct mms_field *field);

// The name of a parameter, in the order of the file; NULL beyond the last.
const char *mms_field_parameter_name(const struct mms_field *field, size_t index);

// How many faces the body of a field has; 0 for NULL.
size_t mms_field_face_count(const struct mms_field *field);

// The name of a face, such as "x_max" or "inner"; NULL beyond the last.
const char *mms_field_face_name(const struct mms_field *field, size_t index);

// How many quantities the file of a field defines beside those of every field: of given fields and of balances; 0 for NULL.
size_t mms_field_own_quantity_count(const struct mms_field *field);

// The name of a quantity that the file of a field defines, such as "p_gradient"; NULL beyond the last.
const char *mms_field_own_quantity_name(const struct mms_field *field,
                                        size_t index);

// Writes the value of a parameter to `*value`.
//
// Codes: MMS_CODE_UNKNOWN_NAME.
mms_code mms_field_get_parameter(const struct mms_field *field,
                                 const char *name,
                                 double *value,
                                 char *message,
                                 size_t capacity);

// Sets a parameter. Parameters whose defaults depend on it follow, unless they were set.
//
// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_PARAMETER. On failure nothing changes.
mms_code mms_field_set_parameter(struct mms_field *field,
                                 const char *name,
                                 double value,
                                 char *message,
                                 size_t capacity);

// Sets `count` parameters at once, where one alone would not be allowed, as in a body that moves
// away. An evaluation on another thread sees all of them or none.
//
// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_PARAMETER. On failure nothing changes.
mms_code mms_field_set_parameters(struct mms_field *field,
                                  size_t count,
                                  const char *const *names,
                                  const double *values,
                                  char *message,
                                  size_t capacity);

// Writes the number of components of a quantity to `*components`: 1, D for a vector, D x D for a tensor. A vector of an
// axisymmetric field has 2, or 3 with a swirl, and its tensors have 9.
//
// Codes: MMS_CODE_UNKNOWN_NAME.
mms_code mms_field_components(const struct mms_field *field,
                              const char *quantity,
                              size_t *components,
                              char *message,
                              size_t capacity);

// Evaluates a quantity at `count` points of the reference body, at one time.
//
// `quantity` is a name, or one of the symbols u x v a H F J C B E rho P sigma b W. `points` are count x
// D coordinates, those of a point side by side. `values` get count x C numbers, those of a point
// side by side, with C from `mms_field_components`; a tensor is stored by rows. `normals` are count
// x D components of reference unit normals for "traction" (see `mms_field_normals`), and NULL for
// all else. `values` may not overlap with the others.
//
// Every value is a finite number, or the call fails: the message then names the first point, and
// `values` are unspecified.
//
// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_ARGUMENT, MMS_CODE_NOT_FINITE.
mms_code mms_field_evaluate(const struct mms_field *field,
                            const char *quantity,
                            double time,
                            size_t count,
                            const double *points,
                            const double *normals,
                            double *values,
                            char *message,
                            size_t capacity);

// The same as `mms_field_evaluate`, until somebody requests to stop. NULL for `stop` means that nobody will.
//
// Codes: those of `mms_field_evaluate`, MMS_CODE_STOPPED.
mms_code mms_field_evaluate_stoppable(const struct mms_field *field,
                                      const char *quantity,
                                      double time,
                                      size_t count,
                                      const double *points,
                                      const double *normals,
                                      const struct mms_stop *stop,
                                      double *values,
                                      char *message,
                                      size_t capacity);

// Writes the outward reference unit normals of a face at `count` points of it: count x D numbers for
// count x D coordinates.
//
// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_ARGUMENT, MMS_CODE_NOT_FINITE.
mms_code mms_field_normals(const struct mms_field *field,
                           const char *face,
                           size_t count,
                           const double *points,
                           double *normals,
                           char *message,
                           size_t capacity);

// Writes the number of components of a bound to `*components`: D, 1 or 2, see `mms_field_get_bound`.
//
// Codes: MMS_CODE_UNKNOWN_NAME, also where the body has no such bound.
mms_code mms_field_bound_components(const struct mms_field *field,
                                    const char *name,
                                    size_t *components,
                                    char *message,
                                    size_t capacity);

// Writes where the body or the time window ends: "lower", "upper" (D coordinates each, of a box),
// "inner", "outer" (a radius each, of what is round), "theta" (first and last angle), "z" (the ends of a
// cylinder), "phi" (first and last angle from +Z of a sphere), "vertices" (of a polygon, X and Y of one after
// another), "time" (first and last). It follows the parameters. `values` has room for `room` numbers; where that is not enough,
// nothing is written to it.
//
// Codes: MMS_CODE_UNKNOWN_NAME, also where the body has no such bound; MMS_CODE_INVALID_ARGUMENT.
mms_code mms_field_get_bound(const struct mms_field *field,
                             const char *name,
                             size_t room,
                             double *values,
                             char *message,
                             size_t capacity);

// The same as `mms_field_get_bound`, where `values` has room for all components; 3 are always enough.
// It stays for programs that call it. New ones say how much room there is.
//
// Codes: MMS_CODE_UNKNOWN_NAME, also where the body has no such bound.
mms_code mms_field_bound(const struct mms_field *field,
                         const char *name,
                         double *values,
                         char *message,
                         size_t capacity);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MMS_CAPI_H */
