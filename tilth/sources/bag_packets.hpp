// Packets in the messages of a bag.
#pragma once

#include <tilth/sources/bag_reader.hpp>
#include <tilth/sources/bag_topic.hpp>
#include <tilth/sources/packet_source.hpp>

namespace tilth {

/// Those of `topic`, whose type is_packet_message(), of the sensor with that `frame`; empty: the first one's. `name` is
/// that of the feed. Messages that cannot be read are passed over and told in problem().
PacketFeed bag_packet_feed(BagReader bag, const BagTopic& topic, const std::string& name, const std::string& frame);

}  // namespace tilth
