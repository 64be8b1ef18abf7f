#include <mpm/core/error.hpp>
#include <mpm/output/folder_lock.hpp>

#include <array>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mpm::output {

namespace {

std::string host_name()
{
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown host";
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(folder / "in_use.lock")
{
  do {
    close();
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) return;  // the first result to be written says what is wrong
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) continue;
    const int cause = errno;
    close();
    if (cause != EWOULDBLOCK) {
      remove_file();
      return;
    }
    std::string holder;
    std::getline(std::ifstream(file_), holder);
    throw InputError(fmt::format(
        "{}: a run is writing there{}. Wait until it has ended, or choose another folder "
        "with --output.",
        folder.string(), holder.empty() ? "" : fmt::format(" ({})", holder)));
  } while (!bears_its_name());
  name_holder();
}

FolderLock::~FolderLock()
{
  if (descriptor_ < 0) return;
  remove_file();
  close();
}

void FolderLock::remove_file() const
{
  std::error_code stays;  // and locks nothing
  std::filesystem::remove(file_, stays);
}

void FolderLock::close()
{
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

bool FolderLock::bears_its_name() const
{
  struct stat held = {};
  struct stat named = {};
  return ::fstat(descriptor_, &held) == 0 && ::stat(file_.c_str(), &named) == 0 &&
         held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

void FolderLock::name_holder() const
{
  const std::string holder = fmt::format("process {} on {}\n", ::getpid(), host_name());
  // Without a name it locks all the same, on a full disk too.
  if (::ftruncate(descriptor_, 0) != 0) return;
  [[maybe_unused]] const ssize_t written = ::write(descriptor_, holder.data(), holder.size());
}

}  // namespace mpm::output
