/* Code that the programs share. An access to the byte after the end of a memory block is a fault. With HEAP, malloc
 * allocates the blocks: sanitizers and valgrind detect such accesses, and reads of uninitialised memory. */
#ifndef SUPPORT_H
#define SUPPORT_H

#define _DEFAULT_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { MOST_ROOMS = 4096 };

static struct {
    void *start;
    size_t size;
} rooms[MOST_ROOMS];
static size_t room_count;

static void *must_be(void *start)
{
    if (start == NULL || start == MAP_FAILED || room_count == MOST_ROOMS) {
        perror("memory for a test");
        exit(2);
    }
    return start;
}

/* Allocates `size` bytes with arbitrary contents. */
static void *room(size_t size)
{
    void *start;
    char *end;
#ifdef HEAP
    start = must_be(malloc(size > 0 ? size : 1));
    end = (char *)start + size;
#else
    size_t page = (size_t)sysconf(_SC_PAGESIZE), inside = (size + page - 1) / page * page;
    start = must_be(mmap(NULL, inside + page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    if (inside > 0 && mprotect(start, inside, PROT_READ | PROT_WRITE) != 0) {
        must_be(NULL);
    }
    end = (char *)start + inside;
    memset(start, 0xA5, inside);
    rooms[room_count].size = inside + page;
#endif
    rooms[room_count++].start = start;
    return end - size;
}

/* Frees all rooms except the first `count`. */
static void give_back(size_t count)
{
    while (room_count > count) {
        --room_count;
#ifdef HEAP
        free(rooms[room_count].start);
#else
        munmap(rooms[room_count].start, rooms[room_count].size);
#endif
    }
}

/* Whether bytes are whole characters of UTF-8. */
static int is_utf8(const char *text, size_t length)
{
    const unsigned char *byte = (const unsigned char *)text, *end = byte + length;
    while (byte < end) {
        int more = *byte < 0x80 ? 0 : *byte >= 0xF0 ? 3 : *byte >= 0xE0 ? 2 : *byte >= 0xC2 ? 1 : 4;
        if (more == 4 || more >= end - byte) {
            return 0;
        }
        for (++byte; more > 0; --more, ++byte) {
            if ((*byte & 0xC0) != 0x80) {
                return 0;
            }
        }
    }
    return 1;
}

/* Fields that take little time to make. */
static const char cube_text[] =
    "[field]\n"
    "title = \"A cube that is stretched\"\n"
    "dimension = 3\n"
    "[parameters]\n"
    "rho0 = { value = 1000 }\n"
    "rate = { value = 0.1 }\n"
    "[displacement]\n"
    "u = [\"rate*X*t^2\", 0, 0]\n"
    "[material]\n"
    "model = \"linear_elastic\"\n"
    "lambda = 1\n"
    "mu = 1\n"
    "density = \"rho0\"\n"
    "[domain]\n"
    "shape = \"box\"\n"
    "lower = [0, 0, 0]\n"
    "upper = [1, 1, 1]\n"
    "time = [0, 1]\n";
static const char ring_text[] =
    "[field]\n"
    "title = \"A ring that swells\"\n"
    "dimension = 2\n"
    "[parameters]\n"
    "rate = { value = 0.1 }\n"
    "[displacement]\n"
    "u = [\"rate*X*t^2\", \"rate*Y*t^2\"]\n"
    "[material]\n"
    "model = \"linear_elastic\"\n"
    "lambda = 1\n"
    "mu = 1\n"
    "density = 1000\n"
    "[domain]\n"
    "shape = \"annulus\"\n"
    "inner = 0.5\n"
    "outer = 1\n"
    "time = [0, 1]\n";

#endif
