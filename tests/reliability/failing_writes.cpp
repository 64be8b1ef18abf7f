/// To be preloaded into mpm_par: what goes into files below a folder fails now and then, as on a
/// disk that is full or broken. Sockets and pipes, by which the ranks talk, are left alone.
///
///   MPM_FAILING_FOLDER   absolute path
///   MPM_FAILING_SHARE    of the calls that fail, from 0 to 1
///   MPM_FAILING_ERRNO    what they fail with
///   MPM_FAILING_SEED     other seeds, other calls; each process adds its id

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

double number_of(const char* name, double otherwise)
{
  const char* text = std::getenv(name);
  return text != nullptr ? std::atof(text) : otherwise;
}

bool is_below_folder(const char* path)
{
  static const char* const folder = std::getenv("MPM_FAILING_FOLDER");
  return folder != nullptr && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool is_below_folder(int file)
{
  struct stat found {};
  if (fstat(file, &found) != 0 || !S_ISREG(found.st_mode)) return false;
  char link[64], path[PATH_MAX];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length <= 0) return false;
  path[length] = '\0';
  return is_below_folder(path);
}

template <class Place>
bool fails(Place place)
{
  static const double share = number_of("MPM_FAILING_SHARE", 0);
  static unsigned state = unsigned(number_of("MPM_FAILING_SEED", 1)) + unsigned(getpid());
  if (!is_below_folder(place) || rand_r(&state) >= share * RAND_MAX) return false;
  errno = int(number_of("MPM_FAILING_ERRNO", EIO));
  return true;
}

template <class Call>
Call next(const char* name)
{
  return reinterpret_cast<Call>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* from, size_t size)
{
  static const auto call = next<ssize_t (*)(int, const void*, size_t)>("write");
  return fails(file) ? -1 : call(file, from, size);
}

ssize_t writev(int file, const iovec* from, int count)
{
  static const auto call = next<ssize_t (*)(int, const iovec*, int)>("writev");
  return fails(file) ? -1 : call(file, from, count);
}

ssize_t pwrite(int file, const void* from, size_t size, off_t at)
{
  static const auto call = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  return fails(file) ? -1 : call(file, from, size, at);
}

ssize_t pwrite64(int file, const void* from, size_t size, off64_t at)
{
  static const auto call = next<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
  return fails(file) ? -1 : call(file, from, size, at);
}

ssize_t pwritev(int file, const iovec* from, int count, off_t at)
{
  static const auto call = next<ssize_t (*)(int, const iovec*, int, off_t)>("pwritev");
  return fails(file) ? -1 : call(file, from, count, at);
}

int fsync(int file)
{
  static const auto call = next<int (*)(int)>("fsync");
  return fails(file) ? -1 : call(file);
}

int rename(const char* from, const char* to)
{
  static const auto call = next<int (*)(const char*, const char*)>("rename");
  return fails(to) ? -1 : call(from, to);
}

}  // extern "C"
