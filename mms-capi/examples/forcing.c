/* b of the 1-D bar with half its amplitude, at five points and one time; and a mistake. */
#include <mms_capi.h>
#include <stdio.h>
#include <stdlib.h>

static char message[1024];

/* Ends the program where a call fails. */
static void must(mms_code code)
{
    if (code != MMS_CODE_OK) {
        fprintf(stderr, "%s\n", message);
        exit(1);
    }
}

int main(void)
{
    mms_field *bar;
    must(mms_field_from_gallery("bar_1d", &bar, message, sizeof message));
    must(mms_field_set_parameter(bar, "amplitude", 0.1, message, sizeof message));
    printf("%s: %s\n", mms_field_name(bar), mms_field_title(bar));

    double lower[1], upper[1], X[5], b[5];
    must(mms_field_get_bound(bar, "lower", 1, lower, message, sizeof message));
    must(mms_field_get_bound(bar, "upper", 1, upper, message, sizeof message));
    for (int i = 0; i < 5; ++i) {
        X[i] = lower[0] + (upper[0] - lower[0]) * i / 4;
    }
    must(mms_field_evaluate(bar, "body_force", 0.013, 5, X, NULL, b, message, sizeof message));
    for (int i = 0; i < 5; ++i) {
        printf("%8.4f %14.6f\n", X[i], b[i]);
    }

    mms_code code = mms_field_set_parameter(bar, "amplitud", 0.1, message, sizeof message);
    printf("%d: %s\n", (int)code, message);
    mms_field_free(bar);
    return 0;
}
