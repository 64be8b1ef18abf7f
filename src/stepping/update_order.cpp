#include <mpm/stepping/update_order.hpp>

#include <stdexcept>

namespace mpm {

template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_update_order(UpdateOrderKind kind)
{
  switch (kind) {
    case UpdateOrderKind::musl:
      return make_musl<Dim>();
    case UpdateOrderKind::usf:
      return make_usf<Dim>();
    case UpdateOrderKind::usl:
      return make_usl<Dim>();
  }
  throw std::logic_error("an update order without steps");
}

template std::unique_ptr<UpdateOrder<2>> make_update_order(UpdateOrderKind);
template std::unique_ptr<UpdateOrder<3>> make_update_order(UpdateOrderKind);

}  // namespace mpm
