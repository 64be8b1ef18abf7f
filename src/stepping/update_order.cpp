#include <mpm/stepping/update_order.hpp>
#include <mpm/transfer/order_types.hpp>

namespace mpm {

template <int Dim>
StepFunction<Dim> step_function(OneOf<UpdateOrderRow> order)
{
  StepFunction<Dim> function = nullptr;
  for_each_type(OrderTypes{}, [&]<class Order>() {
    if (order == Order::row.keyword) function = &Order::template step<Step<Dim>>;
  });
  return function;
}

template StepFunction<2> step_function(OneOf<UpdateOrderRow>);
template StepFunction<3> step_function(OneOf<UpdateOrderRow>);

}  // namespace mpm
