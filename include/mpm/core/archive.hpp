#pragma once
/// State by name, on its way out or back in: one function of each owner serves both, so that what
/// is saved is what is loaded.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mpm {

/// What a value of each rank is to all of them, where a state goes to another number of ranks.
enum class Over {
  same,     ///< on every rank
  sum,      ///< of what each rank has had of it
  largest,  ///< of what the ranks have
};

/// Names are unique within their section. Loading throws InputError for a name that is not there,
/// or values of another kind or number.
///
/// What ranks saved is loaded on as many ranks, or *regrouped* on any number of them, which have
/// their shares of particles and nodes and ask for them by key.
class Archive {
 public:
  virtual ~Archive() = default;

  virtual bool is_loading() const = 0;
  virtual void values(std::string_view name, std::span<double> values, Over over = Over::same) = 0;
  virtual void values(std::string_view name, std::span<std::int64_t> values,
                      Over over = Over::same) = 0;
  /// A list whose length is part of the state; the same on every rank where it is regrouped.
  virtual void list(std::string_view name, std::vector<double>& list) = 0;
  virtual void list(std::string_view name, std::vector<std::int64_t>& list) = 0;
  virtual void text(std::string_view name, std::string& text) = 0;

  void value(std::string_view name, double& value, Over over = Over::same)
  {
    values(name, std::span(&value, 1), over);
  }
  void value(std::string_view name, std::int64_t& value, Over over = Over::same)
  {
    values(name, std::span(&value, 1), over);
  }
  void value(std::string_view name, int& value, Over over = Over::same)
  {
    std::int64_t wide = value;
    this->value(name, wide, over);
    value = int(wide);
  }

  virtual bool regroups() const { return false; }
  /// Rows as long as they come, of particles or nodes that have keys. `rows` says, where they are
  /// regrouped, which rows of all ranks', one rank behind the other, are these.
  virtual void rows(std::string_view name, std::span<const std::int64_t> rows,
                    std::span<double> values) = 0;
  virtual void rows(std::string_view name, std::span<const std::int64_t> rows,
                    std::span<std::int64_t> values) = 0;
  /// Of all ranks' list `name`, one rank behind the other: where each key stands; -1 where nowhere.
  /// Only where they are regrouped, as the two below.
  virtual std::vector<std::int64_t> places_of(std::string_view name,
                                              std::span<const std::int64_t> keys) = 0;
  /// Which rows of `width` values are wanted.
  virtual std::vector<std::int64_t> rows_where(
      std::string_view name, int width,
      const std::function<bool(std::span<const double> row)>& wanted) = 0;
  /// What is in this section has no meaning to other ranks.
  virtual void pass_over(std::string_view section) = 0;
  /// What nobody has asked for since loading began, in alphabetical order.
  virtual std::vector<std::string> unread() const = 0;

  /// While it lives, names are within `name`.
  class Section {
   public:
    Section(Archive& archive, std::string_view name) : archive_(archive) { archive_.enter(name); }
    ~Section() { archive_.leave(); }
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;

   private:
    Archive& archive_;
  };

 private:
  virtual void enter(std::string_view name) = 0;
  virtual void leave() = 0;
};

}  // namespace mpm
