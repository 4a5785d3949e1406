#include <tilth/sensor/packet_format.hpp>

namespace tilth {
namespace {

constexpr PacketLayout usual_layout() {
  return {.size = 1206,
          .header = 0,
          .blocks = 12,
          .slots = 32,
          .block_header = 4,
          .slot_size = 3,
          .mode = 1204,
          .model = 1205,
          .time = 1200};
}

constexpr PacketLayout hdl64_layout() {
  PacketLayout layout = usual_layout();
  layout.mode = layout.model = 0, layout.banks = 2;
  return layout;
}

constexpr PacketLayout vls128_layout() {
  PacketLayout layout = usual_layout();
  layout.banks = 4, layout.echoes_by_bank = true;
  return layout;
}

constexpr PacketLayout leishen_layout() {
  PacketLayout layout = usual_layout();
  layout.size = 1212, layout.mode = 1210, layout.model = 1211, layout.fraction = 1206, layout.dated = true;
  return layout;
}

/// `slots` lasers of four bytes and a tail that begins with the return mode.
constexpr PacketLayout xt_layout(std::size_t slots) {
  PacketLayout layout{.size = 0,
                      .header = 12,
                      .blocks = 8,
                      .slots = slots,
                      .block_header = 2,
                      .slot_size = 4,
                      .mode = 0,
                      .model = 6,
                      .time = 0};
  const std::size_t tail = layout.header + layout.blocks * layout.block_size();
  layout.size = tail + 28, layout.mode = tail + 10, layout.time = tail + 13, layout.fraction = tail + 19;
  layout.flag = BlockFlag::none, layout.dated = true, layout.years = YearZero::of_1900;
  return layout;
}

/// A tail with [us] at `fraction`, return mode four bytes and the date six bytes behind it.
constexpr PacketLayout pandar_layout(PacketLayout layout, std::size_t fraction, std::size_t tail_size) {
  const std::size_t tail = layout.header + layout.blocks * layout.block_size();
  layout.size = tail + tail_size, layout.fraction = tail + fraction;
  layout.mode = layout.fraction + 4, layout.time = layout.fraction + 6, layout.dated = true;
  return layout;
}

constexpr PacketLayout pandar64_layout() {
  PacketLayout layout{.size = 0,
                      .header = 8,
                      .blocks = 6,
                      .slots = 64,
                      .block_header = 2,
                      .slot_size = 3,
                      .mode = 0,
                      .model = 2,
                      .time = 0};
  layout.flag = BlockFlag::none;
  return pandar_layout(layout, 10, 22);
}

constexpr PacketLayout pandar40p_layout() {
  PacketLayout layout{.size = 0,
                      .header = 0,
                      .blocks = 10,
                      .slots = 40,
                      .block_header = 4,
                      .slot_size = 3,
                      .mode = 0,
                      .model = 0,
                      .time = 0};
  layout.flag = BlockFlag::either;
  return pandar_layout(layout, 10, 22);
}

constexpr PacketLayout qt64_layout() {
  PacketLayout layout{.size = 0,
                      .header = 12,
                      .blocks = 4,
                      .slots = 64,
                      .block_header = 2,
                      .slot_size = 4,
                      .mode = 0,
                      .model = 6,
                      .time = 0};
  layout.flag = BlockFlag::none, layout.years = YearZero::of_1900;
  return pandar_layout(layout, 12, 28);
}

constexpr PacketLayout robosense_layout(std::size_t model, FractionForm fraction) {
  PacketLayout layout = usual_layout();
  layout.size = 1248, layout.header = 42, layout.mode = 0, layout.model = model;
  layout.time = 20, layout.fraction = 26, layout.fraction_form = fraction;
  layout.dated = true, layout.big_endian = true;
  return layout;
}

}  // namespace

const PacketLayout& layout_of(PacketFamily family) {
  static constexpr PacketLayout kUsual = usual_layout(), kHdl64 = hdl64_layout(), kVls128 = vls128_layout();
  static constexpr PacketLayout kLeishen = leishen_layout(), kXt16 = xt_layout(16), kXt32 = xt_layout(32);
  static constexpr PacketLayout kPandar64 = pandar64_layout(), kPandar40p = pandar40p_layout(), kQt64 = qt64_layout();
  static constexpr PacketLayout kRs = robosense_layout(30, FractionForm::milli_and_micro);
  static constexpr PacketLayout kHelios = robosense_layout(0, FractionForm::big);
  switch (family) {
    case PacketFamily::velodyne_64: return kHdl64;
    case PacketFamily::velodyne_128: return kVls128;
    case PacketFamily::leishen_1212: return kLeishen;
    case PacketFamily::hesai_568: return kXt16;
    case PacketFamily::hesai_xt32: return kXt32;
    case PacketFamily::hesai_64: return kPandar64;
    case PacketFamily::hesai_40p: return kPandar40p;
    case PacketFamily::hesai_qt64: return kQt64;
    case PacketFamily::robosense: return kRs;
    case PacketFamily::robosense_helios: return kHelios;
    default: return kUsual;
  }
}

FactoryPorts factory_ports(PacketFamily family) {
  switch (family) {
    case PacketFamily::robosense:
    case PacketFamily::robosense_helios: return {6699, 7788};
    case PacketFamily::leishen_1206:
    case PacketFamily::leishen_1212: return {2368, 2369};
    default: return {2368, 0};
  }
}

}  // namespace tilth
