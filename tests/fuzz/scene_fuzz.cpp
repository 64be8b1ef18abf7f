/// Any bytes as a scene: refused with words, or a scene that says the same when it is written out
/// with all that the reader has filled in, and read again.

#include <mpm/core/error.hpp>
#include <mpm/scene/reader.hpp>

#include <sstream>

#include "file_in_memory.hpp"

namespace {

std::string effective(const std::uint8_t* bytes, std::size_t size)
{
  const FileInMemory file(bytes, size);
  std::ostringstream text;
  mpm::scene::write_effective_scene(text, mpm::scene::read_scene(file.path()));
  return text.str();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  std::string once;
  try {
    once = effective(bytes, size);
  } catch (const mpm::InputError& error) {
    if (std::string(error.what()).empty()) throw std::logic_error("refused without a word");
    return 0;
  }
  // What was accepted must be accepted again.
  const std::string twice =
      effective(reinterpret_cast<const std::uint8_t*>(once.data()), once.size());
  if (twice != once) throw std::logic_error("another scene when read again:\n" + once + twice);
  return 0;
}
