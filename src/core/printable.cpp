#include <mpm/core/printable.hpp>

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

namespace mpm {

namespace {

bool continues(char byte)
{
  return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
}

/// Bytes of the character that begins here; 0: there is none.
std::size_t length_of_character(std::string_view text)
{
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 0;
  if (length == 0 || length > text.size() || first > 0xF4) return 0;
  std::uint32_t code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if (!continues(text[i])) return 0;
    code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3Fu);
  }
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code >= smallest[length] && code <= 0x10FFFF && !surrogate ? length : 0;
}

}  // namespace

std::optional<std::string> unprintable(std::string_view text)
{
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::size_t length = length_of_character(text.substr(at));
    if (length == 0) return fmt::format("byte {} is 0x{:02X}, no UTF-8", at + 1, byte);
    if ((byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7F)
      return fmt::format("byte {} is the control character 0x{:02X}", at + 1, byte);
    at += length;
  }
  return std::nullopt;
}

std::string shortened(std::string text, std::size_t longest)
{
  std::ranges::replace(text, '\n', ' ');
  if (text.size() <= longest) return text;
  while (longest > 0 && continues(text[longest])) --longest;
  return text.substr(0, longest) + "...";
}

}  // namespace mpm
