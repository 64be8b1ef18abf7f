#pragma once
/// What every file that calls HDF5 needs of it.

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>

#include <hdf5.h>

namespace mpm::output {

static_assert(std::is_same_v<hid_t, std::int64_t>);

/// An HDF5 identifier and the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle()
  {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// What HDF5 says about its last failure: the innermost cause comes first.
inline std::string last_hdf5_message()
{
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* entry, void* out) -> herr_t {
        auto& words = *static_cast<std::string*>(out);
        if (depth < 2 && entry->desc != nullptr) {
          if (!words.empty()) words += ": ";
          words += entry->desc;
        }
        return 0;
      },
      &text);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "no reason given" : text;
}

template <class T>
hid_t native_type()
{
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

}  // namespace mpm::output
