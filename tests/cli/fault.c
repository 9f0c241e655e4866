// SPDX-License-Identifier: Apache-2.0
// For LD_PRELOAD: system calls on files whose path contains FAULT_PATH fail with FAULT_ERRNO, from the FAULT_AFTER-th such call on.
// FAULT_CALLS names them: write (pwrite, fwrite and fflush too), fsync, rename, open (of files to be written), mkdir. So tests meet full
// and read-only disks without a disk of their own and without privileges.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int fails(const char* call, const char* path) {
    static int count;
    const char *calls = getenv("FAULT_CALLS"), *part = getenv("FAULT_PATH"), *after = getenv("FAULT_AFTER"), *number = getenv("FAULT_ERRNO");
    if (!calls || !part || !path || !strstr(calls, call) || !strstr(path, part)) return 0;
    if (__sync_add_and_fetch(&count, 1) <= (after ? atoi(after) : 0)) return 0;
    errno = number ? atoi(number) : ENOSPC;
    return 1;
}

static int fails_fd(const char* call, int fd) {
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    const ssize_t n = readlink(link, path, sizeof path - 1);
    if (n < 0) return 0;
    path[n] = 0;
    return fails(call, path);
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int fd, const void* b, size_t n) { return fails_fd("write", fd) ? -1 : NEXT(write)(fd, b, n); }
ssize_t pwrite(int fd, const void* b, size_t n, off_t o) { return fails_fd("write", fd) ? -1 : NEXT(pwrite)(fd, b, n, o); }
ssize_t pwrite64(int fd, const void* b, size_t n, off64_t o) { return fails_fd("write", fd) ? -1 : NEXT(pwrite64)(fd, b, n, o); }
size_t fwrite(const void* b, size_t s, size_t n, FILE* f) { return fails_fd("write", fileno(f)) ? 0 : NEXT(fwrite)(b, s, n, f); }
int fsync(int fd) { return fails_fd("fsync", fd) ? -1 : NEXT(fsync)(fd); }
int rename(const char* a, const char* b) { return fails("rename", b) ? -1 : NEXT(rename)(a, b); }
int mkdir(const char* p, mode_t m) { return fails("mkdir", p) ? -1 : NEXT(mkdir)(p, m); }
static int opened(const char* p, int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT)) && fails("open", p); }
int open(const char* p, int flags, ...) {
    va_list a;
    va_start(a, flags);
    const mode_t mode = (flags & O_CREAT) ? va_arg(a, mode_t) : 0;
    va_end(a);
    return opened(p, flags) ? -1 : NEXT(open)(p, flags, mode);
}
int open64(const char* p, int flags, ...) {
    va_list a;
    va_start(a, flags);
    const mode_t mode = (flags & O_CREAT) ? va_arg(a, mode_t) : 0;
    va_end(a);
    return opened(p, flags) ? -1 : NEXT(open64)(p, flags, mode);
}
