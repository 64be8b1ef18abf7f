// The keys of a material: its name, its law, and what the laws in the list ask for.
#include <mpm/scene/schema.hpp>

namespace mpm::scene {

namespace {

/// A parameter and the laws that have it, word for word the same.
struct Shared {
  LawParameter parameter;
  std::vector<std::string> laws;
};

std::vector<Shared> law_parameters()
{
  std::vector<Shared> list;
  for (const LawRow& law : list_of<LawRow>())
    for (const LawParameter& parameter : law.parameters) {
      LawParameter shown = parameter;
      shown.example = 0;  // of the law, not of the key
      auto same = std::ranges::find(list, shown, &Shared::parameter);
      if (same == list.end()) same = list.insert(same, {shown, {}});
      same->laws.push_back(law.keyword);
    }
  return list;
}

/// Of a vector.
using Components = PerAxis<double>;

/// What the scene says, or the default.
std::optional<ParameterValue> value_of(const Material& material, const LawParameter& parameter)
{
  const ParameterValue* given = material.values.find(parameter.key);
  return given ? *given : parameter.default_value();
}

Condition<Material> condition_of(const Shared& shared)
{
  const auto only = shared.parameter.only;
  const auto has_word = [only](const Material& material) {
    const auto& keys = material.law->parameters;
    const auto key = std::ranges::find(keys, only->key, &LawParameter::key);
    return key != keys.end() && value_of(material, *key) == ParameterValue(only->word);
  };
  return {
      [laws = shared.laws, only, has_word](const Material& material) {
        return std::ranges::find(laws, material.law->keyword) != laws.end() &&
               (!only || has_word(material));
      },
      "law " + alternatives(shared.laws) + (only ? " with " + only->key + " " + only->word : "")};
}

double held(double number)
{
  return number;
}
std::vector<double> held(const Components& components)
{
  return {components.begin(), components.end()};
}
void take(const ParameterValue& value, double& number)
{
  number = std::get<double>(value);
}
void take(const ParameterValue& value, Components& components)
{
  std::ranges::copy(std::get<std::vector<double>>(value), components.begin());
}

/// A number, or the components of a vector.
template <class T>
Parameter<Material> row_of_numbers(const LawParameter& p)
{
  const Rule rule{p.quantity, p.bound};
  return {p.key,
          p.help,
          Value<T>::describe(rule),
          p.fallback ? Need::optional : Need::required,
          "",
          false,
          [p, rule](const Given& given, Material& material, int dimensions) {
            Rule here = rule;
            here.dimensions = dimensions;
            T value{};
            const bool good = Value<T>::read(given, here, value);
            if (good) material.values.set(p.key, held(value));
            return good;
          },
          [p, rule](const Material& material, int dimensions) {
            Rule here = rule;
            here.dimensions = dimensions;
            T value{};
            if (const auto found = value_of(material, p)) take(*found, value);
            return Value<T>::write(value, here);
          }};
}

Parameter<Material> row_of_words(const LawParameter& p)
{
  return {p.key,
          p.help,
          words_as_code(p.choices),
          Need::optional,
          "",
          true,
          [p](const Given& given, Material& material, int) {
            const auto place = read_word(given, p.choices);
            if (place) material.values.set(p.key, p.choices[*place]);
            return place.has_value();
          },
          [p](const Material& material, int) {
            return Node::of(std::get<std::string>(*value_of(material, p)));
          }};
}

Parameter<Material> row_of(const LawParameter& p)
{
  if (!p.choices.empty()) return row_of_words(p);
  const bool vector = p.fallback && std::holds_alternative<std::vector<double>>(*p.fallback);
  return vector ? row_of_numbers<Components>(p) : row_of_numbers<double>(p);
}

}  // namespace

template <>
const std::vector<Parameter<Material>>& parameters<Material>()
{
  static const std::vector<Parameter<Material>> rows = [] {
    std::vector<Parameter<Material>> list{
        member<Material>("law", &Material::law, {}, "how stress follows from strain"),
        member<Material>("name", &Material::name, {},
                         "for bands and shapes; needed with several materials")};
    for (const Shared& shared : law_parameters())
      list.push_back(row_of(shared.parameter).when(condition_of(shared)));
    return list;
  }();
  return rows;
}

}  // namespace mpm::scene
