// Times of packets from the sensor's clock, which wraps, may run free or stand still, and from the receiver's, which
// jitters and may be set. What they mean is decided once, over the first packets; after that times never jump back, nor
// ahead where only one of both clocks does.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilth {

/// The clocks when one packet was sent.
struct ClockReading {
  double sensor = 0.0;                 ///< [s] of the sensor's clock
  std::optional<double> arrival = {};  ///< [s] since 1970, of the receiver's
  std::optional<bool> next_head = {};  ///< the head stands where it does one packet after the last; nothing: not known
};

/// What is known of the sensor's clock beside its readings.
struct ClockTraits {
  double wrap = 0.0;      ///< [s] after which it begins at 0 again; 0: never
  double step = 0.0;      ///< [s] from one packet to the next
  bool absolute = false;  ///< it counts from 1970
  struct Mark {
    std::size_t reading = 0;  ///< of the first ones
    double utc = 0.0;         ///< [s] since 1970, within a second of that reading
  };
  std::optional<Mark> mark;
};

class PacketClock {
 public:
  /// Decides from the readings of the first packets, of which there must be one.
  PacketClock(std::span<const ClockReading> first, const ClockTraits& traits);

  /// [s] of a packet, each call for the next one; nothing where it repeats or comes after a later one.
  std::optional<double> time(const ClockReading& reading);

  const std::string& decision() const { return decision_; }
  bool runs_free() const { return runs_free_; }  ///< nothing sets the sensor's clock, so the receiver's was taken once
  std::size_t jumps() const { return jumps_; }   ///< times at which the sensor's clock was set anew
  std::size_t receiver_jumps() const { return receiver_jumps_; }  ///< and the receiver's

 private:
  std::optional<double> advance(const ClockReading& reading);
  std::optional<double> next_time(const ClockReading& reading);
  double by_one_clock(double sensor, double expected);
  double stood_still(const ClockReading& reading);
  void anchor(std::span<const double> running, double arrival_offset);
  bool set_by_mark(std::span<const double> running);
  void match_hours(double arrival_offset);

  ClockTraits traits_;
  bool still_ = false;  // the sensor's clock does not run
  bool runs_free_ = false;
  double base_ = 0.0;                          // [s] wraps and jumps so far
  double offset_ = 0.0;                        // [s] from the running clock to the times given out
  std::optional<double> last_, last_arrival_;  // [s] on the running clock
  std::size_t jumps_ = 0, receiver_jumps_ = 0;
  std::string decision_;
};

}  // namespace tilth
