/* Loaded before the C library by fault_injection.py: makes the n-th call that could change a file below
   FISSURA_FAULT_FOLDER fail with FISSURA_FAULT_ERRNO (and all later ones, with FISSURA_FAULT_STAYS). With FISSURA_FAULT_LIST
   it names every such call on the terminal. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static long calls = 0;
static char about[2 * PATH_MAX]; /* the file that the last call meant */

static int is_below(char const* path) {
  char const* folder = getenv("FISSURA_FAULT_FOLDER");
  char whole[2 * PATH_MAX];
  if (!folder || !path) return 0;
  if (path[0] != '/') { /* a run that goes on names its files from the working folder on */
    if (!getcwd(whole, PATH_MAX)) return 0;
    strcat(whole, "/");
    strncat(whole, path, PATH_MAX - 2);
    path = whole;
  }
  if (strncmp(path, folder, strlen(folder)) != 0) return 0;
  if (path != about) snprintf(about, sizeof about, "%s", path);
  return 1;
}

static int is_descriptor_below(int descriptor) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  ssize_t const n = readlink(link, path, sizeof path - 1);
  if (n <= 0) return 0;
  path[n] = 0;
  return is_below(path);
}

/* Whether this call has to fail; tells the test which one it was. */
static int fails(char const* call) {
  char const* wanted = getenv("FISSURA_FAULT_CALL");
  char const* code = getenv("FISSURA_FAULT_ERRNO");
  if (!wanted || !code) return 0;
  long const n = atol(wanted);
  ++calls;
  if (getenv("FISSURA_FAULT_LIST")) dprintf(2, "[call %s %s]\n", call, about);
  if (calls != n && !(getenv("FISSURA_FAULT_STAYS") && calls > n)) return 0;
  if (calls == n) dprintf(2, "[fault %s]\n", call);
  errno = atoi(code);
  return 1;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int is_writing(int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0; }

#define OPEN(name)                                             \
  int name(char const* path, int flags, ...) {                 \
    mode_t mode = 0;                                           \
    if (flags & O_CREAT) {                                     \
      va_list list;                                            \
      va_start(list, flags);                                   \
      mode = va_arg(list, mode_t);                             \
      va_end(list);                                            \
    }                                                          \
    if (is_writing(flags) && is_below(path) && fails("open")) return -1; \
    return REAL(name)(path, flags, mode);                      \
  }
OPEN(open)
OPEN(open64)

#define FOPEN(name)                                                                       \
  FILE* name(char const* path, char const* mode) {                                        \
    if (strpbrk(mode, "wa+") && is_below(path) && fails("fopen")) return NULL;            \
    return REAL(name)(path, mode);                                                        \
  }
FOPEN(fopen)
FOPEN(fopen64)

ssize_t write(int descriptor, void const* bytes, size_t size) {
  if (is_descriptor_below(descriptor) && fails("write")) return -1;
  return REAL(write)(descriptor, bytes, size);
}
int fsync(int descriptor) {
  if (is_descriptor_below(descriptor) && fails("fsync")) return -1;
  return REAL(fsync)(descriptor);
}
int close(int descriptor) {
  int const below = is_descriptor_below(descriptor);
  int const writing = below && is_writing(fcntl(descriptor, F_GETFL));
  int const result = REAL(close)(descriptor);
  return writing && fails("close") ? -1 : result;
}
int rename(char const* from, char const* to) {
  if (is_below(to) && fails("rename")) return -1;
  return REAL(rename)(from, to);
}
int mkdir(char const* path, mode_t mode) {
  if (is_below(path) && fails("mkdir")) return -1;
  return REAL(mkdir)(path, mode);
}
int ftruncate(int descriptor, off_t size) {
  if (is_descriptor_below(descriptor) && fails("ftruncate")) return -1;
  return REAL(ftruncate)(descriptor, size);
}
int remove(char const* path) {
  if (is_below(path) && fails("remove")) return -1;
  return REAL(remove)(path);
}
