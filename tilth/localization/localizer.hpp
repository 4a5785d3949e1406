// A LiDAR in a saved map: found in it without being told where it is, followed by odometry and by registrations to the
// map, and found again where it was lost. What is not known is said: "ambiguous", with the places it may be.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include <tilth/core/error.hpp>
#include <tilth/localization/map_state.hpp>
#include <tilth/localization/map_tracker.hpp>
#include <tilth/localization/place_finder.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/slam/keyframe.hpp>

namespace tilth {

struct LocalizerOptions {
  double window = 3.0;
  double first_after = 1.0;
  double retry = 0.5;
  double step = 0.5;
  int track_patches = 500;
  double at_radius = 5.0;
  double min_fit = 0.35;
  double usual_share = 0.6;
  double max_through = 0.25;
  double lost_after = 1.0;
  KeyframeOptions keyframe;
  TileOptions tiles;
  PlaceCheckOptions check;
  PlaceFinderOptions find;
  MapTrackerOptions track;
};

template <class V>
void visit(LocalizerOptions& o, V&& v) {
  v("window", o.window, Bounds{0.1, 60}, "[s] of the newest scans, by which places are recognised");
  v("first_after", o.first_after, Bounds{0, 60}, "[s] of scans before a place is looked for at all");
  v("retry", o.retry, Bounds{0, 60}, "[s] from one search to the next, until a place is found");
  v("step", o.step, Bounds{0, 60}, "[s] from one registration to the map to the next");
  v("track_patches", o.track_patches, Bounds{50, 1e6}, "[patches] of a scan that are registered to the map", kAdvanced);
  v("at_radius", o.at_radius, Bounds{0.1, 1000}, "[m] about a pose that was given, within which a place is taken");
  v("min_fit", o.min_fit, Bounds{0, 1}, "[-] share of a scan on surfaces of the map below which the map is not heard",
    kAdvanced);
  v("usual_share", o.usual_share, Bounds{0, 1}, "[-] of the usual fit below which the map is not heard", kAdvanced);
  v("max_through", o.max_through, Bounds{0, 1}, "[-] share of beams through surfaces of the map that shows a loss",
    kAdvanced);
  v("lost_after", o.lost_after, Bounds{0, 60}, "[s] without a fit, where the map has surfaces, until it is lost");
  v("keyframe", o.keyframe, "[-] patches of a scan", kAdvanced);
  v("tiles", o.tiles, "[-] parts of the map in memory", kAdvanced);
  v("check", o.check, "[-] registration and judgement of a place", kAdvanced);
  v("find", o.find, "[-] global search");
  v("track", o.track, "[-] tracking in the map", kAdvanced);
}

/// The options that every pipeline shares, under "localize.".
struct LocalizationOptions {
  LocalizerOptions localize;
};

template <class V>
void visit(LocalizationOptions& o, V&& v) {
  v("localize", o.localize, "[-] localisation in a saved map");
}

struct LocatedScan {
  MapState state = MapState::searching;
  std::optional<Pose> T_map_lidar = {};    ///< at the stamp of `odometry`, where it is known
  Matrix6d covariance = Matrix6d::Zero();  ///< [rad^2, m^2] of it, right perturbation
  double overlap = 0.0, through = 0.0;     ///< of the last registration to the map
  std::vector<PlaceFit> hypotheses = {};   ///< of a search, where there was one at this scan
  OdometryResult odometry = {};
};

/// A scan that the odometry refuses: it is passed over.
struct UnusableScan : Error {
  using Error::Error;
};

class Localizer {
 public:
  using MakeOdometry = std::function<std::unique_ptr<Odometry>()>;

  /// `map` must outlive this; `T_map_guess`: about where the first scan was taken.
  Localizer(const PlaceMap& map, MakeOdometry make_odometry, const LocalizerOptions& options,
            const std::optional<Pose>& T_map_guess);

  /// The next scan; stamps must ascend. Throws UnusableScan where the odometry throws, Error where the map cannot be
  /// read.
  LocatedScan add(const Scan& scan);

  const LocalizerOptions& options() const { return options_; }

  /// Forgets where it is, and the scans so far.
  void forget();

 private:
  struct Recent {
    double stamp;  // [s]
    Pose T_odometry_lidar;
    SurfacePatches patches;
  };

  OdometryResult try_scan(const Scan& scan);
  OdometryResult register_scan(const Scan& scan, bool& lost);
  bool remember(const OdometryResult& result, double scan_stamp);
  PlaceQuery query() const;
  void search(LocatedScan& located);
  void follow(LocatedScan& located);
  void judge(const PlaceFit& fit, LocatedScan& located);
  void lose(LocatedScan& located);
  std::vector<Pose> carried(const Pose& T_odometry_lidar) const;

  MakeOdometry make_odometry_;
  LocalizerOptions options_;
  MapTiles tiles_;
  PlaceFinder finder_;
  std::optional<Pose> T_map_guess_;
  std::unique_ptr<Odometry> odometry_;
  std::deque<Recent> recent_;
  std::optional<Pose> T_odometry_last_;
  double begun_ = 0.0, searched_ = 0.0, fitted_ = 0.0;  // [s]
  std::vector<Pose> carried_;                           // T_map_odometry of hypotheses that may be
  std::optional<MapTracker> tracker_;
  double usual_ = 0.0;  // overlap
  double overlap_ = 0.0, through_ = 0.0;
  bool hears_ = true;  // the map
};

}  // namespace tilth
