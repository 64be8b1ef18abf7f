/// Hands files to a fuzz target, and then copies of them with random changes, always the same ones:
/// what a build without a fuzzer can try.
///
///   scene_replay [--mutations N] FILE_OR_FOLDER...
///
/// An input on which the target fails, or takes more than ten seconds, stays behind as
/// `failed_input` in the working folder.

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr unsigned seconds_of_one_input = 10;
constexpr std::size_t most_bytes = 20'000;
constexpr long most_kib = 2'000'000;

const Bytes* tried = nullptr;

/// By system calls alone: also called from a signal handler.
void leave_input()
{
  const int file = open("failed_input", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0 || !tried || write(file, tried->data(), tried->size()) < 0) return;
  close(file);
}

void end_with_input(int signal)
{
  leave_input();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void attempt(const Bytes& input)
{
  tried = &input;
  alarm(seconds_of_one_input);
  LLVMFuzzerTestOneInput(input.data(), input.size());
  alarm(0);
}

Bytes contents(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Of files and of what is in folders, in the order of their names.
std::vector<Bytes> inputs_of(std::vector<std::filesystem::path> places)
{
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& place : places) {
    if (!std::filesystem::is_directory(place)) {
      files.push_back(place);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(place))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<Bytes> inputs;
  for (const std::filesystem::path& file : files) inputs.push_back(contents(file));
  return inputs;
}

/// Random changes of a kind that files get, or that readers of files do not expect.
class Mutation {
 public:
  explicit Mutation(const std::vector<Bytes>& inputs) : inputs_(inputs) {}

  Bytes operator()()
  {
    Bytes bytes = any_input();
    if (bytes.size() > most_bytes) bytes.resize(most_bytes);
    for (std::size_t changes = 1 + below(6); changes > 0; --changes) change(bytes);
    return bytes;
  }

 private:
  std::size_t below(std::size_t bound)
  {
    return std::size_t(random_() % std::max<std::size_t>(bound, 1));
  }
  const Bytes& any_input() { return inputs_[below(inputs_.size())]; }

  void insert(Bytes& bytes, std::string_view text)
  {
    const auto at = bytes.begin() + std::ptrdiff_t(below(bytes.size() + 1));
    bytes.insert(at, text.begin(), text.end());
  }

  /// A part of an input in the place of another.
  void splice(Bytes& bytes, const Bytes& from)
  {
    const std::size_t first = below(from.size()),
                      count = below(std::min<std::size_t>(from.size() - first + 1, 200));
    const std::size_t at = below(bytes.size()),
                      gone = below(std::min<std::size_t>(bytes.size() - at + 1, 200));
    bytes.erase(bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(at + gone));
    bytes.insert(bytes.begin() + std::ptrdiff_t(at), from.begin() + std::ptrdiff_t(first),
                 from.begin() + std::ptrdiff_t(first + count));
  }

  void set_integer(Bytes& bytes)
  {
    static constexpr std::array<std::uint64_t, 10> values{
        0, 1, 0x7f, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, ~0ull};
    const std::uint64_t value = values[below(values.size())];
    const std::size_t width = std::size_t(1) << below(4), at = below(bytes.size());
    for (std::size_t k = 0; k < width && at + k < bytes.size(); ++k)
      bytes[at + k] = std::uint8_t(value >> (8 * k));
  }

  void change(Bytes& bytes)
  {
    static constexpr std::array<std::string_view, 24> words{
        "-1", "0",   "1e308", "1e-320", "nan", "inf", " mm", " GPa", ": ",  "\n  ", "[",    "]",
        "{}", "&a ", "*a",    "!!int ", "~",   "\"",  "\t",  "\r\n", "|\n", "? ",   "\xff", "- "};
    if (bytes.empty()) return insert(bytes, words[below(words.size())]);
    const std::size_t at = below(bytes.size());
    switch (below(7)) {
      case 0:
        bytes[at] ^= std::uint8_t(1u << below(8));
        break;
      case 1:
        bytes[at] = std::uint8_t(random_());
        break;
      case 2:
        set_integer(bytes);
        break;
      case 3:
        insert(bytes, words[below(words.size())]);
        break;
      case 4:
        bytes.resize(at);
        break;
      case 5:
        splice(bytes, Bytes(bytes));
        break;
      default:
        splice(bytes, any_input());
    }
  }

  const std::vector<Bytes>& inputs_;
  std::mt19937_64 random_{1};
};

}  // namespace

int main(int argc, char** argv)
{
  std::vector<std::string> words(argv + 1, argv + argc);
  long mutations = 0;
  if (words.size() > 1 && words[0] == "--mutations") {
    mutations = std::stol(words[1]);
    words.erase(words.begin(), words.begin() + 2);
  }
  const std::vector<Bytes> inputs = inputs_of({words.begin(), words.end()});
  if (inputs.empty()) {
    std::fprintf(stderr, "no input\n");
    return 2;
  }
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM})
    std::signal(signal, end_with_input);
  for (const Bytes& input : inputs) attempt(input);
  Mutation mutation(inputs);
  for (long k = 0; k < mutations; ++k) attempt(mutation());
  rusage used;
  getrusage(RUSAGE_SELF, &used);
  std::printf("%zu inputs, %ld changed copies, %.1f s, %ld MB at most\n", inputs.size(), mutations,
              double(used.ru_utime.tv_sec) + 1e-6 * double(used.ru_utime.tv_usec),
              used.ru_maxrss / 1000);
  if (used.ru_maxrss > most_kib) {
    std::fprintf(stderr, "more memory than an input may take\n");
    return 1;
  }
  return 0;
}
