// Packets of a recording as they were sent, not yet scans: what is played to a receiver, or stored otherwise.
#pragma once

#include <string>

#include <tilth/sources/packet_source.hpp>

namespace tilth {

/// Packets with their arrival of a network capture, a file of payloads (their arrival by the sensor's period), a bag
/// with packets (of `topic`, where there are several) or a simulation (sim://SCENE?key=value&..., the next scan is made
/// in the background). Throws Error where there are none, naming what there is.
PacketFeed open_packet_feed(const std::string& uri, const std::string& topic);

/// A source that open_packet_feed() takes, as far as its name tells.
bool may_hold_packets(const std::string& uri);

}  // namespace tilth
