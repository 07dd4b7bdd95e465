// SPDX-License-Identifier: MIT
/// @file
/// Lamps.
#pragma once

namespace rtapi {

namespace detail {
struct LampImpl;
}

/// A lamp.
class Lamp {
 public:
  /// Turns it on.
  /// @errors KA0904 empty handle.
  Status TurnOn();
  Status TurnOff();
  /// Lumens.
  float flux() const;
  float power() const;
  /// Breaks it.
  Status Break();
  /// @overload
  Status Break(int how);
  /// The room's lamps.
  /// @errors those of the room.
  template <class T>
  static Result<T> Find(T room);

 private:
  // Nobody sees it.
  int filament_ = 0;
};

// Not a comment for the manual.
float brightest(const Lamp& a, const Lamp& b);

}  // namespace rtapi
