#include <mpm/core/error.hpp>
#include <mpm/output/replace_file.hpp>

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

namespace mpm::output {

namespace {

/// A POSIX file descriptor: unlike a stream it can be synced and says why a write failed.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags)
      : file_(file), number_(::open(file.c_str(), flags | O_CLOEXEC, 0666))
  {
    if (number_ < 0) fail("open");
  }
  ~Descriptor()
  {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write(std::string_view text) const
  {
    while (!text.empty()) {
      const ssize_t written = ::write(number_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("write");
      text.remove_prefix(std::size_t(written));
    }
  }
  void reserve(std::int64_t bytes) const
  {
    int status = 0;
    do status = ::fallocate(number_, 0, 0, bytes);
    while (status != 0 && errno == EINTR);  // a signal came, of which the run will hear
    if (status != 0 && errno != EOPNOTSUPP && errno != ENOSYS) fail("reserve room for");
  }
  void sync() const
  {
    // EINVAL: a special file or a file system that cannot sync, which loses nothing we could save.
    if (::fsync(number_) != 0 && errno != EINVAL) fail("sync");
  }
  void close()
  {
    const int number = number_;
    number_ = -1;
    if (::close(number) != 0) fail("close");
  }

 private:
  [[noreturn]] void fail(const char* action) const
  {
    throw FileError(fmt::format("{}: cannot {} the file ({}). Check the disk and the permissions.",
                                file_.string(), action, std::strerror(errno)));
  }

  std::filesystem::path file_;
  int number_;
};

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& file)
{
  std::filesystem::path name = file;
  name += ".part";
  return name;
}

void give_name(const std::filesystem::path& from, const std::filesystem::path& file)
{
  std::error_code error;
  std::filesystem::rename(from, file, error);
  if (error)
    throw FileError(fmt::format("{}: cannot take its name ({}). Check what stands there.",
                                file.string(), error.message()));
}

void rename_when_synced(const std::filesystem::path& temporary, const std::filesystem::path& file)
{
  Descriptor(temporary, O_RDONLY).sync();
  give_name(temporary, file);
  const std::filesystem::path directory = file.parent_path();
  Descriptor(directory.empty() ? "." : directory, O_RDONLY | O_DIRECTORY).sync();
}

void replace_file(const std::filesystem::path& file, std::string_view text)
{
  const std::filesystem::path temporary = temporary_name(file);
  try {
    Descriptor descriptor(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    descriptor.write(text);
    descriptor.close();
    rename_when_synced(temporary, file);
  } catch (const FileError&) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void reserve_room(const std::filesystem::path& file, std::int64_t bytes)
{
  const Descriptor descriptor(file, O_WRONLY | O_CREAT);
  try {
    descriptor.reserve(bytes);
  } catch (const FileError&) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    throw;
  }
}

void make_directory(const std::filesystem::path& directory)
{
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error)
    throw FileError(
        fmt::format("{}: cannot create the directory ({}). Choose another with --output, or remove "
                    "what stands there.",
                    directory.string(), error.message()));
}

}  // namespace mpm::output
