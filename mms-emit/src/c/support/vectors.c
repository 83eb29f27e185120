static FILE *vectors;
static double numbers[LARGEST];
static int accepted[2];

/* Opens the test vectors: in this folder, or at the path in the first argument. */
static void open_vectors(int count, char **arguments)
{
    const char *const path = count > 1 ? arguments[1] : "VECTORS";
    vectors = fopen(path, "r");
    if (vectors == NULL) {
        printf("cannot open %s: run this in its folder, or give its path\n", path);
        exit(2);
    }
}

/* Reads the next table with a name: its numbers, and the accepted errors. */
static void table(const char *name, int rows, int columns)
{
    char line[LINE], word[LINE];
    int found[2];
    while (fgets(line, LINE, vectors) != NULL) {
        if (sscanf(line, "%s %d %d %d %d", word, &found[0], &found[1], &accepted[0], &accepted[1]) == 5
            && strcmp(word, name) == 0 && found[0] == rows && found[1] == columns) {
            int k = 0;
            while (k < rows * columns && fscanf(vectors, "%lf", &numbers[k]) == 1) {
                k++;
            }
            if (k == rows * columns) {
                return;
            }
        }
    }
    printf("the test vectors have no table %s of %d x %d numbers: emit them anew\n", name, rows, columns);
    exit(2);
}
