/// draw_wood: a micrograph of a transverse section of wood from a parameter file.

#include <mpm/core/error.hpp>
#include <mpm/core/terminal.hpp>
#include <mpm/micrograph/anatomy_drawing.hpp>
#include <mpm/micrograph/anatomy_parameters.hpp>

#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace {

using namespace mpm;
namespace anatomy = micrograph::anatomy;

struct Request {
  std::string parameters, picture;
  std::optional<std::uint64_t> seed;
  bool png = false;
};

void draw_picture(const Request& request)
{
  const anatomy::Parameters wood = anatomy::read_parameters(request.parameters);
  const anatomy::Drawing drawing = anatomy::draw(wood, request.seed.value_or(wood.seed));
  if (request.png)
    anatomy::write_png(drawing, request.picture);
  else
    anatomy::write_bmp(drawing, wood.picture, request.picture);
  fmt::print("{}: {} x {} px, {} lumens\n", request.picture, drawing.width, drawing.height,
             drawing.lumens.size());
  for (std::size_t w = 0; w < drawing.density.size(); ++w)
    fmt::print("  relative density {:.4f} for x = {:g} ... {:g} of the width (walls x {:.3f})\n",
               drawing.density[w], wood.density->windows[w].from, wood.density->windows[w].to,
               drawing.wall_scale[w]);
}

ExitStatus failed(const std::exception& error, ExitStatus status)
{
  print_message(error.what());
  return status;
}

ExitStatus attempt(const Request& request)
{
  try {
    draw_picture(request);
    return ExitStatus::done;
  } catch (const InputError& error) {
    return failed(error, ExitStatus::bad_input);
  } catch (const FileError& error) {
    return failed(error, ExitStatus::file_failure);
  }
}

}  // namespace

int main(int argc, char** argv)
{
  Request request;
  bool keys = false;
  CLI::App app{"Draws a micrograph of wood: the same bytes for the same parameters and seed."};
  app.add_option("parameters", request.parameters, "parameter file (*.anatomy.yaml)");
  app.add_option("-o,--output", request.picture, "picture to write");
  app.add_option("--seed", request.seed, "another piece of the same kind of wood");
  app.add_flag("--png", request.png, "write a PNG instead of a BMP");
  app.add_flag("--keys", keys, "print the keys of a parameter file and stop");
  CLI11_PARSE(app, argc, argv);
  if (keys) {
    fmt::print("{}", anatomy::key_table());
    return 0;
  }
  if (request.parameters.empty() || request.picture.empty()) {
    fmt::print(stderr,
               "draw_wood: needs a parameter file and -o PICTURE (see draw_wood --help).\n");
    return static_cast<int>(ExitStatus::bad_input);
  }
  return static_cast<int>(attempt(request));
}
