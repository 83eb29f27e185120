/* Manufactured solutions for solid mechanics: any field, any quantity, in batches.
 *
 * Names and texts are UTF-8 and end with a NUL. A name has at most 4096 bytes, the content of a file 1 MiB, and no byte beyond
 * is read. Numbers are double, angles are in radians, units are the field's, SI in the gallery. D is the dimension of a field.
 *
 * Functions that can fail return a code, and have a buffer `message` of `capacity` bytes for the error message: a text that
 * ends with a NUL, cut between characters if the buffer is too small for all of it, empty if the call succeeded. NULL is
 * allowed if no message is needed; 1024 bytes are enough except for the mistakes of a field file. The message is written last:
 * the buffer may overlap with an argument.
 *
 * Every pointer is checked before it is used, as far as possible. MMS_CODE_INVALID_ARGUMENT is returned for a required pointer
 * that is NULL, a pointer that is not aligned for its type, a count that no array has, results that overlap with arguments or
 * the message, and a text that is not UTF-8. Memory for results may be uninitialised, and only results are written to it; after
 * a failure its contents are unspecified, unless documented as NULL. The functions cannot check that memory of the stated size
 * exists and is not changed during the call, nor that a field was made and not freed: the caller is responsible. Arrays of no
 * elements may be NULL.
 *
 * There is no global state. Any function may be called on any thread at any time, also on one field: an evaluation uses the
 * parameters of the moment at which it starts. Only mms_field_free must be the last call. No panic leaves the library: it
 * becomes MMS_CODE_DEFECT.
 *
 * Making a field from a text may take seconds, and the time of an evaluation grows with the number of points. The functions
 * whose names end with _stoppable can be stopped from another thread, or from a signal handler. All other functions take about
 * a second at most, or can be split by passing points in parts.
 *
 * Two conditions end the program, as abort() does: too little memory, and a stack that is too small. Making a field temporarily
 * takes at most 128 MiB of memory, all other calls little, for any number of points. Making a field runs on a separate thread
 * with a stack of 2 MiB, which ends before the call does; if the system provides none, the code is MMS_CODE_NO_THREAD. All
 * other calls run on the thread of the caller, which needs a stack of 64 KiB. Rounding must be to nearest, and floating-point
 * exceptions masked, as at the start of a program.
 *
 * Values have the same bits as from `mms eval`. They are interpreted: a point takes less than a microsecond, and the points of
 * a call share the terms of the parameters and the time. For inner loops, embed the code that `mms emit` writes.
 *
 * Before version 1, each minor version has its own interface. Within one, functions and codes are only added: treat an unknown
 * code as a failure.
 */


#ifndef MMS_CAPI_H
#define MMS_CAPI_H

/* Made of mms-capi/src/abi.rs: MMS_BLESS=1 cargo test -p mms-capi --test suite header */

#include <stddef.h>
#include <stdint.h>

// The result of a call.
enum mms_code
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // The call succeeded.
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
  // A value that the field does not allow: outside its range, or one for which there is no body, no time window or no
  // positive density.
  MMS_CODE_INVALID_PARAMETER = 4,
  // A value that is not defined at a point, or is beyond the range of a double.
  MMS_CODE_NOT_FINITE = 5,
  // A defect of this library.
  MMS_CODE_DEFECT = 6,
  // The system provides no thread. Making a field needs one, with a stack of 2 MiB.
  MMS_CODE_NO_THREAD = 7,
  // A stop was requested, and nothing was made.
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

// An object by which calls are stopped.
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

// Makes `*field` the field of a text, the content of a field file. Messages call it `name`. `material` is the content of the
// material file that the field names, as in `model = "./mine.toml"`, or NULL if it names a material that ships.
//
// Codes: MMS_CODE_INVALID_FIELD, with every mistake at its line and column. On failure `*field` is NULL.
mms_code mms_field_from_text(const char *name,
                             const char *toml,
                             const char *material,
                             struct mms_field **field,
                             char *message,
                             size_t capacity);

// Makes `*field` as `mms_field_from_text` does, until `mms_stop_request`. `stop` may be NULL.
//
// Codes: MMS_CODE_INVALID_FIELD, MMS_CODE_STOPPED. On failure `*field` is NULL.
mms_code mms_field_from_text_stoppable(const char *name,
                                       const char *toml,
                                       const char *material,
                                       const struct mms_stop *stop,
                                       struct mms_field **field,
                                       char *message,
                                       size_t capacity);

// Makes the object by which a program stops calls. Never returns NULL.
struct mms_stop *mms_stop_new(void);

// Requests that calls to which `stop` was passed, now or later, end soon: within milliseconds, or some hundred of them if a
// formula is large. A request cannot be withdrawn; further work needs a new `stop`. Any thread may call this at any time, and
// so may a signal handler. NULL is allowed.
void mms_stop_request(const struct mms_stop *stop);

// Whether a stop was requested: 1 or 0; 0 for NULL. A signal handler may call this, too.
int mms_stop_is_requested(const struct mms_stop *stop);

// Frees `stop`, when all calls to which it was passed have ended. NULL is allowed.
void mms_stop_free(struct mms_stop *stop);

// Frees a field, and all texts that its functions returned. NULL is allowed. No other call may be using the field.
void mms_field_free(struct mms_field *field);

// The name of a field; NULL for NULL. All texts of a field are valid until the field is freed.
const char *mms_field_name(const struct mms_field *field);

// The title of a field, a sentence; NULL for NULL.
const char *mms_field_title(const struct mms_field *field);

// D, the number of coordinates of a point: 1, 2 or 3; 0 for NULL.
size_t mms_field_dimension(const struct mms_field *field);

// The number of parameters of a field; 0 for NULL.
size_t mms_field_parameter_count(const struct mms_field *field);

// The name of a parameter, in the order of the file; NULL beyond the last.
const char *mms_field_parameter_name(const struct mms_field *field, size_t index);

// The number of faces of a field's body; 0 for NULL.
size_t mms_field_face_count(const struct mms_field *field);

// The name of a face, such as "x_max" or "inner"; NULL beyond the last.
const char *mms_field_face_name(const struct mms_field *field, size_t index);

// The number of quantities that only the file of a field defines: given fields and balances; 0 for NULL.
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

// Sets a parameter. Parameters whose defaults depend on it change, unless they were set.
//
// Codes: MMS_CODE_UNKNOWN_NAME, MMS_CODE_INVALID_PARAMETER. On failure nothing changes.
mms_code mms_field_set_parameter(struct mms_field *field,
                                 const char *name,
                                 double value,
                                 char *message,
                                 size_t capacity);

// Sets `count` parameters at once. This is needed if one change alone would not be allowed, such as a lower end above the old
// upper end of a body. An evaluation on another thread uses all new values or none.
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
// `quantity` is a name, or one of the symbols u x v a H F J C B E rho P sigma b W. `points` are count x D coordinates, with
// the D coordinates of a point adjacent. `values` get count x C numbers, with the C numbers of a point adjacent and C from
// `mms_field_components`; a tensor is stored by rows. `normals` are count x D components of reference unit normals for
// "traction" (see `mms_field_normals`), and NULL for all other quantities. `values` may not overlap with the others.
//
// Every value is a finite number, or the call fails: the message then names the first point, and `values` are unspecified.
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

// Evaluates as `mms_field_evaluate` does, until `mms_stop_request`. `stop` may be NULL.
//
// Codes: as `mms_field_evaluate`, and MMS_CODE_STOPPED.
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
// Codes: MMS_CODE_UNKNOWN_NAME, also if the body has no such bound.
mms_code mms_field_bound_components(const struct mms_field *field,
                                    const char *name,
                                    size_t *components,
                                    char *message,
                                    size_t capacity);

// Writes a bound of the body or the time window: "lower", "upper" (D coordinates each, of a box), "inner", "outer" (a radius
// each, of a round body), "theta" (first and last angle), "z" (the ends of a cylinder), "phi" (first and last angle from +Z of
// a sphere), "vertices" (of a polygon, X and Y of one after another), "time" (first and last). Bounds depend on the
// parameters. `values` has room for `room` numbers; if that is too small, nothing is written to it.
//
// Codes: MMS_CODE_UNKNOWN_NAME, also if the body has no such bound; MMS_CODE_INVALID_ARGUMENT.
mms_code mms_field_get_bound(const struct mms_field *field,
                             const char *name,
                             size_t room,
                             double *values,
                             char *message,
                             size_t capacity);

// Writes a bound as `mms_field_get_bound` does, into `values` with room for all components; 3 are always enough. Kept for
// programs that call it. New ones pass the size.
//
// Codes: MMS_CODE_UNKNOWN_NAME, also if the body has no such bound.
mms_code mms_field_bound(const struct mms_field *field,
                         const char *name,
                         double *values,
                         char *message,
                         size_t capacity);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MMS_CAPI_H */
