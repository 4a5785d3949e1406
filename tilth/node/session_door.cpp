#include <tilth/node/session_door.hpp>

namespace tilth {
namespace {

/// Open as long as this lives.
struct OpenDoor {
  explicit OpenDoor(SessionDoor& d) : door(d) { door.open(); }
  ~OpenDoor() { door.shut(); }
  SessionDoor& door;
};

class DoorSource final : public ScanSource {
 public:
  DoorSource(SessionDoor& door, std::unique_ptr<ScanSource> source) : door_(door), source_(std::move(source)) {
    contents_ = source_->contents();
    take_words();
  }

  std::optional<Scan> next() override {
    std::optional<Scan> scan = next_outside();
    take_words();
    return scan;
  }

  std::optional<std::size_t> size() const override { return source_->size(); }
  std::vector<std::string> notices() const override { return source_->notices(); }

 private:
  std::optional<Scan> next_outside() {
    const OpenDoor open(door_);
    return source_->next();
  }

  void take_words() {
    if (decisions_.size() != source_->decisions().size()) decisions_ = source_->decisions();
    const std::vector<SkippedScan>& skipped = source_->skipped();
    skipped_.insert(skipped_.end(), skipped.begin() + std::ptrdiff_t(skipped_.size()), skipped.end());
  }

  SessionDoor& door_;
  std::unique_ptr<ScanSource> source_;
};

}  // namespace

void SessionDoor::open() {
  const std::lock_guard lock(mutex_);
  open_ = true;
  changed_.notify_all();
}

void SessionDoor::shut() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return visitors_ == 0; });
  open_ = false;
}

std::unique_ptr<ScanSource> behind(SessionDoor& door, std::unique_ptr<ScanSource> source) {
  return std::make_unique<DoorSource>(door, std::move(source));
}

}  // namespace tilth
