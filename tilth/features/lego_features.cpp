#include <tilth/core/voxel_downsample.hpp>
#include <tilth/features/lego_features.hpp>

namespace tilth {
namespace {

using Indices = std::vector<std::uint32_t>;

// The ground is thinned, but for a few columns at the seam.
bool thinned_away(int column, int columns, int thinning) {
  constexpr int kSeamColumns = 5;
  return column % thinning != 0 && column > kSeamColumns && column < columns - kSeamColumns;
}

// Chooses the features of one scan, sector by sector.
class FeatureChooser {
 public:
  FeatureChooser(const SegmentedScan& scan, const LegoFeatureOptions& options)
      : scan_(scan),
        options_(options),
        curvature_(range_curvature(scan.rows.ranges)),
        picked_(unusable_points(scan.rows)),
        is_edge_(picked_.size(), 0) {}

  LegoFeatures choose() {
    LegoFeatures features;
    for (std::size_t row = 0; row < scan_.rows.rows(); ++row) {
      Indices less_flat;
      for (const Sector& sector : sectors_of_row(scan_.rows, row)) {
        const Indices order = by_curvature(sector, curvature_, options_.sort_all_but_last);
        choose_edges(order);
        choose_flats(order);
        for (std::size_t i = sector.begin; i < sector.end; ++i) {
          if (!is_edge_[i]) less_flat.push_back(std::uint32_t(i));
        }
      }
      append(features.less_flat, voxel_downsample(select(scan_.rows.cloud, less_flat), options_.less_flat_voxel));
    }
    features.sharp = select(scan_.rows.cloud, sharp_);
    features.less_sharp = select(scan_.rows.cloud, less_sharp_);
    features.flat = select(scan_.rows.cloud, flat_);
    return features;
  }

 private:
  void choose_edges(const Indices& order) {
    int count = 0;
    for (auto i = order.rbegin(); i != order.rend() && count < options_.less_sharp; ++i) {
      if (picked_[*i] || scan_.ground[*i] || curvature_[*i] <= options_.edge_threshold) continue;
      if (count++ < options_.sharp) sharp_.push_back(*i);
      less_sharp_.push_back(*i);
      is_edge_[*i] = 1;
      suppress_around(*i, scan_.rows.columns, picked_);
    }
  }

  void choose_flats(const Indices& order) {
    int count = 0;
    for (auto i = order.begin(); i != order.end() && count < options_.flat; ++i) {
      if (picked_[*i] || !scan_.ground[*i] || curvature_[*i] >= options_.plane_threshold) continue;
      ++count;
      flat_.push_back(*i);
      suppress_around(*i, scan_.rows.columns, picked_);
    }
  }

  const SegmentedScan& scan_;
  const LegoFeatureOptions& options_;
  std::vector<double> curvature_;
  std::vector<std::uint8_t> picked_, is_edge_;
  Indices sharp_, less_sharp_, flat_;
};

}  // namespace

SegmentedScan segment(const PointCloud& cloud, const SegmentationOptions& options) {
  const RangeImage image = project(cloud, options.image);
  const std::vector<std::uint8_t> ground = mark_ground(cloud, image, options.ground);
  const std::vector<CellLabel> labels = cluster(image, ground, options.image.row_step, options.clusters);
  SegmentedScan scan;
  scan.keep.assign(cloud.size(), 1);
  std::vector<std::uint8_t> kept(labels.size(), 0);
  Indices outliers;
  for (std::size_t cell = 0; cell < labels.size(); ++cell) {
    const int column = int(cell) % image.columns, row = int(cell) / image.columns;
    kept[cell] = labels[cell] == CellLabel::cluster ||
                 (labels[cell] == CellLabel::ground && !thinned_away(column, image.columns, options.thinning));
    if (kept[cell]) scan.ground.push_back(labels[cell] == CellLabel::ground);
    if (labels[cell] != CellLabel::noise) continue;
    scan.keep[image.points[cell]] = 0;
    if (row > options.ground.rows && column % options.thinning == 0) outliers.push_back(image.points[cell]);
  }
  scan.rows = row_scan(cloud, image, kept);
  scan.outliers = select(cloud, outliers);
  return scan;
}

LegoFeatures lego_features(const SegmentedScan& scan, const LegoFeatureOptions& options) {
  return FeatureChooser(scan, options).choose();
}

}  // namespace tilth
