#include <mpm/core/folded.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/self_test.hpp>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <functional>
#include <stdexcept>

#include "self_test_checks.hpp"
#include <fmt/format.h>
#include <unistd.h>

namespace mpm {

namespace {

std::array<char, 400> words_at_the_limit{};

void end_at_the_limit(int)
{
  const auto written [[maybe_unused]] =
      ::write(STDERR_FILENO, words_at_the_limit.data(), std::strlen(words_at_the_limit.data()));
  ::_exit(1);
}

/// A line for each check, on the rank that prints.
class Table {
 public:
  Table(bool prints, bool quiet, SelfTestLimit& limit)
      : prints_(prints), quiet_(quiet), limit_(limit)
  {
  }

  /// Whether it has passed.
  bool check(const char* name, const std::function<std::string()>& check)
  {
    limit_.begin(name);
    try {
      line("passed", name, check());
      return true;
    } catch (const std::runtime_error& error) {
      ++failed_;
      line("FAILED", name, error.what());
      return false;
    }
  }
  void say(const std::string& text) const
  {
    if (!prints_ || quiet_) return;
    fmt::print("{}\n", text);
    std::fflush(stdout);
  }
  int failed() const { return failed_; }

 private:
  void line(const char* outcome, const char* name, const std::string& found) const
  {
    const bool bad = outcome[0] == 'F';
    if (!prints_ || (quiet_ && !bad)) return;
    std::FILE* const to = quiet_ ? stderr : stdout;
    fmt::print(to, "  {:<6}  {:<14}{}\n", outcome, name, folded(found, 24));
    std::fflush(to);
  }

  bool prints_, quiet_;
  SelfTestLimit& limit_;
  int failed_ = 0;
};

}  // namespace

SelfTestLimit::SelfTestLimit(int seconds, const std::string& what) : seconds_(seconds)
{
  begin(what);
  struct sigaction action {};
  action.sa_handler = end_at_the_limit;
  sigemptyset(&action.sa_mask);
  sigaction(SIGALRM, &action, nullptr);
}

SelfTestLimit::~SelfTestLimit()
{
  ::alarm(0);
}

void SelfTestLimit::begin(const std::string& what)
{
  ::alarm(0);
  const std::string text = fmt::format(
      "self-test: no end of \"{}\" within {} s: ranks, or a rank and its files, do not\n"
      "reach each other. docs/cluster.md says what to look at.\n",
      what, seconds_);
  words_at_the_limit.fill('\0');
  text.copy(words_at_the_limit.data(), words_at_the_limit.size() - 1);
  ::alarm(unsigned(seconds_));
}

bool self_test(MPI_Comm comm, const SelfTestRequest& request, SelfTestLimit& limit)
{
  const auto start = std::chrono::steady_clock::now();
  // Where every process is a world of its own, each is rank 0 of it, and one says so.
  const bool is_first = request.launched && request.launched->ranks != ranks_of(comm)
                            ? request.launched->rank == 0
                            : rank_of(comm) == 0;
  Table table(is_first, request.quiet, limit);
  table.say(fmt::format("self-test on {} rank{}", ranks_of(comm), ranks_of(comm) > 1 ? "s" : ""));
  if (!table.check("one MPI world", [&] { return check_world(comm, request.launched); }))
    return false;
  table.check("cores", [&] { return check_cores(comm); });
  table.check("messages", [&] { return check_messages(comm); });
  std::optional<SelfTestFolder> folder;
  if (table.check("folder", [&] {
        folder.emplace(comm, request.folder);
        return check_shared_folder(comm, folder->path());
      })) {
    const std::filesystem::path& path = folder->path();
    table.check("HDF5", [&] { return check_parallel_file(comm, path); });
    for (const char* formulation : {"updated_lagrangian", "total_lagrangian"})
      table.check(formulation[0] == 'u' ? "updated step" : "total step",
                  [&] { return check_one_rank_agrees(comm, path, formulation); });
    table.check("checkpoint", [&] { return check_checkpoint(comm, path); });
    table.check("speed", [&] { return check_speed(comm, path); });
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  table.say(table.failed() == 0
                ? fmt::format("All passed, in {:.1f} s.", seconds.count())
                : fmt::format("{} failed, in {:.1f} s.", table.failed(), seconds.count()));
  return table.failed() == 0;
}

}  // namespace mpm
