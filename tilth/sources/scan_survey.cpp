#include <algorithm>
#include <cmath>
#include <numeric>

#include <tilth/core/median.hpp>
#include <tilth/sources/scan_survey.hpp>

namespace tilth {
namespace {

constexpr double kGapFactor = 1.5;
constexpr std::size_t kIntensityBins = 8;

/// Intensities come as shares, bytes or wider numbers: the first scan tells.
SurveyHistogram intensity_bins(const std::vector<float>& values) {
  const float largest = *std::max_element(values.begin(), values.end());
  const double full = largest <= 1.0F ? 1.0 : largest <= 255.0F ? 256.0 : 65536.0;
  SurveyHistogram bins{{}, std::vector<std::size_t>(kIntensityBins, 0)};
  for (std::size_t i = 0; i <= kIntensityBins; ++i) bins.borders.push_back(full * double(i) / double(kIntensityBins));
  return bins;
}

}  // namespace

void SurveyHistogram::add(double value) {
  const auto above = std::upper_bound(borders.begin() + 1, borders.end() - 1, value);
  ++counts[std::size_t(above - borders.begin()) - 1];
}

void ScanSurvey::add(const Scan& scan) {
  const PointCloud& cloud = scan.cloud;
  fewest_ = stamps_.empty() ? cloud.size() : std::min(fewest_, cloud.size());
  most_ = std::max(most_, cloud.size());
  points_ += cloud.size();
  stamps_.push_back(scan.stamp);
  for (std::size_t i = 0; i < cloud.size(); i += every_) ranges_.add(cloud.points[i].norm());
  if (cloud.has_times()) {
    ++scans_with_times_;
    longest_turn_ = std::max(longest_turn_, double(*std::max_element(cloud.times.begin(), cloud.times.end())));
  }
  if (cloud.has_rings()) {
    ++scans_with_rings_;
    for (std::size_t i = 0; i < cloud.size(); i += every_) {
      const std::uint16_t ring = cloud.rings[i];
      if (ring >= ring_counts_.size()) ring_counts_.resize(std::size_t(ring) + 1, 0);
      ++ring_counts_[ring];
    }
  }
  if (cloud.intensities.empty()) return;
  const auto [least, most] = std::minmax_element(cloud.intensities.begin(), cloud.intensities.end());
  least_intensity_ = intensities_ ? std::min(least_intensity_, *least) : *least;
  most_intensity_ = intensities_ ? std::max(most_intensity_, *most) : *most;
  if (!intensities_) intensities_ = intensity_bins(cloud.intensities);
  for (std::size_t i = 0; i < cloud.size(); i += every_) intensities_->add(cloud.intensities[i]);
}

double ScanSurvey::duration() const {
  return stamps_.empty() ? 0.0 : stamps_.back() - stamps_.front();
}

double ScanSurvey::step() const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps_.size(); ++i) steps.push_back(stamps_[i] - stamps_[i - 1]);
  if (steps.empty()) return 0.0;
  return median(std::move(steps));
}

std::vector<Gap> ScanSurvey::gaps() const {
  std::vector<Gap> found;
  const double most = kGapFactor * step();
  for (std::size_t i = 1; i < stamps_.size(); ++i) {
    if (stamps_[i] - stamps_[i - 1] > most) found.push_back({i - 1, stamps_[i] - stamps_[i - 1]});
  }
  return found;
}

double ScanSurvey::ratio_nearer(double range) const {
  std::size_t nearer = 0;
  for (std::size_t i = 0; i < ranges_.counts.size() && ranges_.borders[i + 1] <= range; ++i)
    nearer += ranges_.counts[i];
  const std::size_t all = std::accumulate(ranges_.counts.begin(), ranges_.counts.end(), std::size_t{0});
  return all == 0 ? 0.0 : double(nearer) / double(all);
}

}  // namespace tilth
