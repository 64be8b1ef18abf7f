#include <mpm/simulation/kept_state.hpp>

namespace mpm {

template <int Dim>
void archive_run(Archive& archive, Formulation<Dim>& formulation, LoadBalance<Dim>& balance,
                 History<Dim>& history)
{
  const Ownership<Dim>& ownership = formulation.decomposition().ownership();
  std::vector<std::int64_t> borders;
  if (!archive.is_loading()) borders = ownership.packed();
  archive.list("borders", borders);
  if (archive.is_loading()) {
    // Other ranks have borders of their own.
    const Ownership<Dim> next =
        archive.regroups()
            ? ownership
            : Ownership<Dim>::unpacked(formulation.decomposition().geometry(), borders);
    formulation.begin_loading(next);
  }
  {
    const Archive::Section section(archive, "formulation");
    formulation.archive(archive);
  }
  {
    const Archive::Section section(archive, "balance");
    balance.archive(archive);
  }
  const Archive::Section section(archive, "history");
  history.archive(archive);
}

template <int Dim>
void KeptState<Dim>::save(Formulation<Dim>& formulation, LoadBalance<Dim>& balance,
                          History<Dim>& history)
{
  archive_.start_saving();
  archive_run(archive_, formulation, balance, history);
}

template <int Dim>
void KeptState<Dim>::load(Formulation<Dim>& formulation, LoadBalance<Dim>& balance,
                          History<Dim>& history)
{
  archive_.start_loading();
  archive_run(archive_, formulation, balance, history);
}

template void archive_run(Archive&, Formulation<2>&, LoadBalance<2>&, History<2>&);
template void archive_run(Archive&, Formulation<3>&, LoadBalance<3>&, History<3>&);
template class KeptState<2>;
template class KeptState<3>;

}  // namespace mpm
