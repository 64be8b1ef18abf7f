#include <mpm/simulation/kept_state.hpp>

namespace mpm {

template <int Dim>
void KeptState<Dim>::save(Formulation<Dim>& formulation, LoadBalance<Dim>& balance,
                          History<Dim>& history)
{
  archive_.start_saving();
  archive(formulation, balance, history);
  ownership_.emplace(formulation.decomposition().ownership());
}

template <int Dim>
void KeptState<Dim>::load(Formulation<Dim>& formulation, LoadBalance<Dim>& balance,
                          History<Dim>& history)
{
  formulation.begin_loading(ownership_.value());
  archive_.start_loading();
  archive(formulation, balance, history);
}

template <int Dim>
void KeptState<Dim>::archive(Formulation<Dim>& formulation, LoadBalance<Dim>& balance,
                             History<Dim>& history)
{
  {
    const Archive::Section section(archive_, "formulation");
    formulation.archive(archive_);
  }
  {
    const Archive::Section section(archive_, "balance");
    balance.archive(archive_);
  }
  const Archive::Section section(archive_, "history");
  history.archive(archive_);
}

template class KeptState<2>;
template class KeptState<3>;

}  // namespace mpm
