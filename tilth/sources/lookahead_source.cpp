#include <utility>

#include <tilth/sources/lookahead_source.hpp>

namespace tilth {

LookaheadSource::LookaheadSource(std::unique_ptr<ScanSource> source, double seconds) : source_(std::move(source)) {
  contents_ = source_->contents();
  try {
    while (ahead_.empty() || ahead_.back().stamp - ahead_.front().stamp < seconds) {
      std::optional<Scan> scan = source_->next();
      if (!scan) break;
      ahead_.push_back(std::move(*scan));
    }
  } catch (...) {
    problem_ = std::current_exception();
  }
  take_over();
}

std::optional<Scan> LookaheadSource::next() {
  if (!ahead_.empty()) {
    Scan scan = std::move(ahead_.front());
    ahead_.erase(ahead_.begin());
    return scan;
  }
  if (problem_) std::rethrow_exception(std::exchange(problem_, nullptr));
  try {
    std::optional<Scan> scan = source_->next();
    take_over();
    return scan;
  } catch (...) {
    take_over();
    throw;
  }
}

void LookaheadSource::take_over() {
  decisions_ = source_->decisions();
  for (std::size_t i = skipped_.size(); i < source_->skipped().size(); ++i) skipped_.push_back(source_->skipped()[i]);
}

}  // namespace tilth
