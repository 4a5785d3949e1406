// Rooms along a corridor: each opens where there is ground for it, clear of the corridor and of the rooms before.
#pragma once

#include <vector>

#include <tilth/simulation/furniture.hpp>
#include <tilth/simulation/layout.hpp>

namespace tilth {

class RoomsBeside {
 public:
  RoomsBeside(const Path& path, double half_width) : path_(path), half_width_(half_width) {}

  /// Whether a room of the size of `wanted` has ground behind its entry; if so it is taken.
  bool take(const Room& wanted, double door_width);

  struct Taken {
    Room room;
    double door_width;  ///< [m]
  };
  const std::vector<Taken>& taken() const { return taken_; }

 private:
  bool free(const Room& room) const;

  Path path_;
  double half_width_;
  std::vector<Taken> taken_;
};

}  // namespace tilth
