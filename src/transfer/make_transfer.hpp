#pragma once
#include <mpm/transfer/transfer.hpp>

namespace mpm {

/// One shape function with every scheme, compiled by itself (shape_transfer.cpp.in).
template <int Dim, class Shape>
std::unique_ptr<Transfer<Dim>> make_shape_transfer(OneOf<SchemeRow> scheme,
                                                   const TransferOptions& options);

}  // namespace mpm
