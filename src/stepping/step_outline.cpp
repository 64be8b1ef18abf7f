#include <mpm/grid/node_fields.hpp>
#include <mpm/stepping/step_outline.hpp>
#include <mpm/transfer/order_types.hpp>

#include <initializer_list>
#include <utility>

namespace mpm {

namespace {

/// Stands for what an order only hands on.
struct Nothing {};

/// Has what an update order takes of Step, and writes down what is asked of it. A pass that is new
/// in Transfer gets a line here.
template <int Dim>
class Notes {
 public:
  using Fields = NodeFields<Dim>;
  using ColumnOf = NodeColumn (Fields::*)();

  struct Sum {
    std::string name;
    int width;
  };
  using Sums = std::vector<Sum>;

  struct Passes {
    std::string* name;
    Nothing musl_velocity(auto&&...) const { return note("musl_velocity"); }
    Nothing musl_stress(auto&&...) const { return note("musl_stress"); }
    Nothing usavg_stress(auto&&...) const { return note("usavg_stress"); }
    Nothing musl_displacement(auto&&...) const { return note("musl_displacement"); }
    Nothing usf_stress(auto&&...) const { return note("usf_stress"); }
    Nothing usf_velocity(auto&&...) const { return note("usf_velocity"); }
    Nothing usl(auto&&...) const { return note("usl"); }
    Nothing refine_velocity(auto&&...) const { return note("refine_velocity"); }
    Nothing divergence(auto&&...) const { return note("divergence"); }
    Nothing surface(auto&&...) const { return note("surface"); }

   private:
    Nothing note(const char* called) const
    {
      *name = called;
      return {};
    }
  };

  struct Exchanges {
    Notes& notes;
    void pass_and_sum(Nothing, const Sums& sums, Nothing, const auto& pass)
    {
      pass(Nothing());
      notes.add(sums);
    }
    void move_and_sum(Nothing, const Sums& sums, Nothing, double, const auto& pass)
    {
      pass(Nothing(), Nothing());
      notes.add(sums);
    }
  };

  Notes(const StepExtras& extras, bool load_force, bool surface)
      : extras_(extras), load_force_(load_force), surface_(surface)
  {
  }
  Notes(const Notes&) = delete;
  Notes& operator=(const Notes&) = delete;

  std::vector<PassOutline> passes;
  Exchanges exchange{*this};
  Passes transfer{&name_};
  std::vector<Fields> fields;  ///< none: nothing is computed
  Nothing bodies, moment;

  struct NoNodes {
    std::span<const NodeRun<Dim>> runs() const { return {}; }
  };
  NoNodes grid() const { return {}; }
  Nothing fields_of(Nothing) const { return {}; }
  Nothing with_forces(Nothing, double, Nothing) const { return {}; }
  void update_velocity(double)
  {
    find_surfaces();
    for (int k = 0; k < extras_.refinements; ++k) {
      transfer.refine_velocity();
      add(columns({&Fields::remap_column}));
    }
  }
  void remap_velocity()
  {
    transfer.musl_velocity();
    add(columns({&Fields::remap_column}));
  }
  void constrain_gradient(double) { find_surfaces(); }
  void average_divergence()
  {
    if (!extras_.f_bar) return;
    transfer.divergence();
    add({{"divergence", Dim}});
  }
  void reset() {}

  Sums columns(std::initializer_list<ColumnOf> which)
  {
    Sums sums;
    for (const ColumnOf column : which) sums.push_back({name_of(column), (probe_.*column)().width});
    return sums;
  }
  Sums sums(std::initializer_list<ColumnOf> which)
  {
    Sums sums = columns(which);
    if (load_force_) sums.push_back(columns({&Fields::load_force_column}).front());
    return sums;
  }

 private:
  static std::string name_of(ColumnOf column)
  {
    if (column == &Fields::mass_column) return "mass";
    if (column == &Fields::momentum_column) return "momentum";
    if (column == &Fields::force_column) return "force";
    if (column == &Fields::momentum_force_column) return "momentum and force";
    if (column == &Fields::surface_column) return "surface";
    return column == &Fields::remap_column ? "re-mapped momentum" : "load force";
  }

  void find_surfaces()
  {
    if (!std::exchange(surface_, false)) return;
    transfer.surface();
    add(columns({&Fields::surface_column}));
  }

  void add(const Sums& sums)
  {
    PassOutline& pass = passes.emplace_back();
    pass.name = name_;
    for (const Sum& sum : sums) {
      pass.sums.push_back(sum.name);
      pass.values_per_node += sum.width;
    }
  }

  const StepExtras& extras_;
  bool load_force_;
  bool surface_;  ///< and not found yet
  std::string name_;
  Fields probe_{1, {}, 0};
};

}  // namespace

template <int Dim>
std::vector<PassOutline> outline_step(OneOf<UpdateOrderRow> order, const StepExtras& extras,
                                      bool load_force, bool surface)
{
  Notes<Dim> notes(extras, load_force, surface);
  for_each_type(OrderTypes{}, [&]<class Order>() {
    if (order == Order::row.keyword) Order::step(notes, 1.0);
  });
  return notes.passes;
}

template std::vector<PassOutline> outline_step<2>(OneOf<UpdateOrderRow>, const StepExtras&, bool,
                                                  bool);
template std::vector<PassOutline> outline_step<3>(OneOf<UpdateOrderRow>, const StepExtras&, bool,
                                                  bool);

}  // namespace mpm
