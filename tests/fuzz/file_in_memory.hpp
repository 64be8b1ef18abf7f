#pragma once
/// Bytes under the name of a file, without a disk.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

class FileInMemory {
 public:
  FileInMemory(const std::uint8_t* bytes, std::size_t size) : file_(memfd_create("input", 0))
  {
    if (file_ < 0 || write(file_, bytes, size) != ssize_t(size))
      throw std::runtime_error("no file in memory");
  }
  ~FileInMemory() { close(file_); }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};
