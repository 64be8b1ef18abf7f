#include <mpm/core/error.hpp>
#include <mpm/core/nearest_name.hpp>
#include <mpm/core/units.hpp>
#include <mpm/scene/command_line.hpp>
#include <mpm/scene/reader.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace mpm::scene {

namespace {

bool starts_option(const std::string& word)
{
  const bool negative_number =
      word.size() > 1 && (std::isdigit(static_cast<unsigned char>(word[1])) || word[1] == '.');
  return word.size() > 1 && word[0] == '-' && !negative_number;
}

struct Options {
  CommandLine command_line;
  bool reference = false, schema = false;
  std::string time_limit;
  CLI::App app{"Material point method: crushes a specimen read from a micrograph."};

  explicit Options(const std::string& version)
  {
    app.name("mpm_par");
    app.footer("Run in parallel: mpirun -n N mpm_par [options] scene.yaml [PETSc options]");
    app.set_version_flag("--version", version);
    app.add_option("scene", command_line.scene, "Scene file (YAML)");
    app.add_flag(
        "--check", command_line.check,
        "Read the scene, print the plan with the time of a\nrun by a second of steps; leave "
        "no results");
    app.add_option("--preview", command_line.preview,
                   "With the plan: a picture (PNG) of the specimen as\nit was understood")
        ->type_name("FILE");
    app.add_option("--ranks", command_line.ranks,
                   "With the plan: balance and messages on so many\nranks, without running on them")
        ->type_name("P[,P...]")
        ->delimiter(',')
        ->check(CLI::Range(1, 1 << 20))
        ->allow_extra_args(false);
    app.add_option("-o,--output", command_line.output, "Folder of results (results/NAME)")
        ->type_name("DIR");
    app.add_flag("--restart", command_line.restart,
                 "Go on from the newest checkpoint in the folder of\n"
                 "results; from FILE with --restart FILE.h5");
    app.add_flag("--overwrite", command_line.overwrite,
                 "Start anew in a folder with results of a run");
    app.add_option("--time-limit", time_limit,
                   "End with a checkpoint and status 75 after so\nlong, such as \"11.5 h\"")
        ->type_name("DURATION");
    app.add_flag("--report", command_line.report, "Leave a page of the run, report.html");
    app.add_option("--set", command_line.overrides,
                   "Change a key of the scene for this run; may be\nrepeated")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    app.add_flag("--quiet", command_line.quiet, "Print nothing but warnings and errors");
    app.add_flag("--self-test", command_line.self_test,
                 "Without a scene, in 10 s: do ranks, files and\nspeed on this machine work?");
    app.add_flag("--input-reference", reference, "Print the reference of all keys");
    app.add_flag("--input-schema", schema, "Print the JSON schema of scenes, for editors");
  }

  std::vector<std::string> names() const
  {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
  }
};

const std::vector<std::string> short_options{"-h", "-o"};

/// Our words alone; PETSc's options and their values go to `given`, and so does the file behind
/// --restart, as a scene may stand there, too.
std::vector<std::string> without_petsc(const std::vector<std::string>& arguments,
                                       const std::vector<std::string>& names, CommandLine& given)
{
  std::vector<std::string> ours;
  bool scene_seen = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    const auto take_next = [&](std::vector<std::string>& words) {
      if (i + 1 < arguments.size()) words.push_back(arguments[++i]);
    };
    if (word.starts_with("--")) {
      const std::string name = word.substr(0, word.find('='));
      if (std::ranges::find(names, name) == names.end())
        throw InputError(fmt::format("unknown option '{}' ({})", name, suggestion(name, names)));
      if (word.starts_with("--restart=")) {
        ours.push_back(name);
        given.checkpoint = word.substr(name.size() + 1);
        continue;
      }
      ours.push_back(word);
      if (word == "--set" || word == "--output" || word == "--ranks" || word == "--time-limit" ||
          word == "--preview")
        take_next(ours);
      if (word == "--restart" && i + 1 < arguments.size() && arguments[i + 1].ends_with(".h5"))
        given.checkpoint = arguments[++i];
    } else if (std::ranges::find(short_options, word) != short_options.end()) {
      ours.push_back(word);
      if (word == "-o") take_next(ours);
    } else if (!starts_option(word)) {
      if (scene_seen)
        throw InputError(
            fmt::format("'{}' is a second scene (one run is one scene). Put a list or "
                        "a value with spaces in quotes.",
                        word));
      scene_seen = true;
      ours.push_back(word);
    } else if (!scene_seen) {
      throw InputError(fmt::format(
          "unknown option '{}' (before the scene). Put options for PETSc behind the scene.", word));
    } else {
      given.petsc.push_back(word);
      if (i + 1 < arguments.size() && !starts_option(arguments[i + 1])) take_next(given.petsc);
    }
  }
  return ours;
}

/// What the words on restart and time mean.
void take_continuation(Options& options)
{
  CommandLine& given = options.command_line;
  if (given.restart && given.overwrite)
    throw InputError("--restart goes on with what --overwrite would take away. Give one of them.");
  if (given.checkpoint && given.checkpoint->extension() != ".h5")
    throw InputError(
        fmt::format("--restart is {} (a checkpoint ends with .h5). Name one, or none "
                    "for the newest in the folder of results.",
                    given.checkpoint->string()));
  if (options.time_limit.empty()) return;
  try {
    given.time_limit = to_si(options.time_limit, Quantity::time);
  } catch (const UnitError& error) {
    throw InputError(fmt::format("--time-limit is {} ({}). Write e.g. \"11.5 h\".",
                                 options.time_limit, error.what()));
  }
  if (!(*given.time_limit > 0))
    throw InputError(fmt::format("--time-limit is {} (must be above 0). Write e.g. \"11.5 h\".",
                                 options.time_limit));
}

/// It has scenes of its own.
void refuse_beside_self_test(const CLI::App& app)
{
  for (const std::string other : {"scene", "--check", "--preview", "--ranks", "--restart",
                                  "--overwrite", "--time-limit", "--set"})
    if (app.count(other) > 0)
      throw InputError(
          fmt::format("{} does not go with --self-test, which has scenes of its own. "
                      "Leave one of them away.",
                      other[0] == '-' ? other : "a " + other));
}

}  // namespace

std::variant<CommandLine, Answer> parse_command_line(const std::vector<std::string>& arguments,
                                                     const std::string& version)
{
  Options options(version);
  std::vector<std::string> ours = without_petsc(arguments, options.names(), options.command_line);
  std::ranges::reverse(ours);  // the order the library takes words from the back in
  try {
    options.app.parse(ours);
  } catch (const CLI::CallForHelp&) {
    return Answer{options.app.help()};
  } catch (const CLI::CallForVersion&) {
    return Answer{version};
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{}. See mpm_par --help.", error.what()));
  }
  if (options.reference || options.schema) {
    std::ostringstream page;
    options.reference ? write_input_reference(page) : write_input_schema(page);
    return Answer{page.str()};
  }
  take_continuation(options);
  if (options.command_line.self_test) {
    refuse_beside_self_test(options.app);
    return std::move(options.command_line);
  }
  if (options.command_line.scene.empty())
    throw InputError("no scene named. Write mpm_par scene.yaml, or see mpm_par --help.");
  if (!options.command_line.ranks.empty() && !options.command_line.check)
    throw InputError("--ranks belongs to --check. Start a run with mpirun -n RANKS.");
  if (options.command_line.report && options.command_line.check)
    throw InputError("--report is of a run, and --check leaves none. Give one of them.");
  if (const auto& preview = options.command_line.preview) {
    if (!options.command_line.check)
      throw InputError("--preview belongs to --check. A run leaves its own, specimen.png.");
    if (preview->extension() != ".png")
      throw InputError(
          fmt::format("--preview is {} (a PNG is written). Name a file that ends with .png.",
                      preview->string()));
  }
  return std::move(options.command_line);
}

std::filesystem::path results_folder(const CommandLine& command_line, const Scene& scene)
{
  return command_line.output.value_or(std::filesystem::path("results") / scene.name);
}

}  // namespace mpm::scene
