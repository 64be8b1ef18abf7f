#include <mpm/scene/reader.hpp>
#include <mpm/scene/schema.hpp>

#include <ostream>

#include <fmt/format.h>

namespace mpm::scene {

namespace {

constexpr std::string_view introduction = R"(# Input reference

Written by `mpm_par --input-reference` from the lists that the program reads scenes with.

A scene is a YAML file. The shortest one crushes a picture of a section:

```yaml
specimen:
  micrograph: section.png     # path from the scene's folder
  pixel_size: 2.3 um
loading:
  piston: right
  speed: 10 m/s
```

- A value with a dimension carries its unit: `10.6 GPa`, `0.832 mm`, `1.5 g/cm^3`, `10 m/s`, `30 deg`.
- A fraction is plain or in percent: `0.6` or `60 %`.
- A scene lies in the plane, or in space if `specimen.size` has three components or a picture a
  `specimen.depth`. Coordinates, sizes and sides then come in threes and sixes. Sides are left and
  right (x), bottom and top (y), back and front (z).
- A key that is unknown, given twice or of no effect is an error, with file, line and column.
- `--set path.to.key=value` changes a key for one run: `--set loading.speed='5 m/s'`,
  `--set materials[0].density='1400 kg/m^3'`.
- The folder of results holds the scene with every default filled in.

## Help while you type

`docs/scene.schema.json`, which `mpm_par --input-schema` prints, tells editors what a scene may hold. One
with a YAML language server (VS Code with the extension *YAML* of Red Hat, Neovim, Emacs, Kate) then offers
keys and words, shows what they mean, and marks what is wrong. Name it in the scene's first line, by its path
from the scene's folder:

```yaml
# yaml-language-server: $schema=../../docs/scene.schema.json
```

or, in VS Code, for all scenes of a folder in its settings:

```json
{"yaml.schemas": {"docs/scene.schema.json": ["inputs/wood/*l.yaml", "my_scenes/*.yaml"]}}
```

The schema takes all that `mpm_par` takes, and more: it knows no units, no formulas, no names of materials and
not whether a scene lies in the plane. `mpm_par --check` has the last word.
)";

template <class Owner>
std::string default_of(const Parameter<Owner>& row)
{
  if (row.need == Need::required) return "**required**";
  if (!row.default_text.empty()) return row.default_text;
  const std::string text = one_line(row.write(Owner{}, 2));
  return text == "\"\"" ? "none" : "`" + text + "`";
}

template <class Owner>
void write_section(std::ostream& out, std::string_view title)
{
  out << "\n## " << title << "\n\n| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const Parameter<Owner>& row : parameters<Owner>()) {
    const std::string belongs_to = row.only();
    const std::string only = belongs_to.empty() ? "" : fmt::format(" ({} only)", belongs_to);
    out << fmt::format("| `{}` | {} | {} | {}{} |\n", row.key, row.type, default_of(row), row.help,
                       only);
  }
}

/// What the words of a list mean.
template <class Row>
void write_words(std::ostream& out, std::string_view key)
{
  out << fmt::format("\n| `{}` | meaning |\n|---|---|\n", key);
  for (const Row& row : list_of<Row>())
    out << fmt::format("| `{}` | {} |\n", row.keyword, row.help);
}

template <class... Owners>
void write_sections(std::ostream& out)
{
  (write_section<Owners>(out, section<Owners>), ...);
}

}  // namespace

void write_input_reference(std::ostream& out)
{
  out << introduction;
  write_sections<SceneKeys, Material>(out);
  write_words<LawRow>(out, "law");
  write_sections<Failure>(out);
  write_sections<Specimen, GrayBand, Window, Shape>(out);
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) { write_sections<Kind>(out); });
  write_sections<Grid, Numerics>(out);
  write_words<ShapeRow>(out, "shape_function");
  write_words<SchemeRow>(out, "scheme");
  write_words<UpdateOrderRow>(out, "update_order");
  write_sections<Loading, LoadCell, FreeMotion>(out);
  write_words<SideRow>(out, "sides");
  write_sections<MovingSide, Load>(out);
  write_words<LoadRow>(out, "kind");
  write_sections<BodyContact, ExactSolution, OutputKeys>(out);
  write_section<SnapshotKeys>(out, snapshots_section);
  write_sections<Checkpoints>(out);
}

}  // namespace mpm::scene
