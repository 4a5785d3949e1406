// FLOAM with statistical outlier removal and GICP: Fu et al., Appl. Sci. 2026, 16, 3141.
#pragma once

#include <memory>
#include <optional>

#include <tilth/features/patch_features.hpp>
#include <tilth/features/surface_patches.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/odometry/external_motion.hpp>
#include <tilth/odometry/motion_model.hpp>
#include <tilth/odometry/odometry.hpp>
#include <tilth/odometry/usual_fit.hpp>
#include <tilth/preprocess/outlier_removal.hpp>
#include <tilth/registration/align.hpp>
#include <tilth/registration/association.hpp>

namespace tilth {

enum class RegistrationMethod { gicp, icp };
inline std::span<const std::string_view> names_of(RegistrationMethod) {
  static constexpr std::array<std::string_view, 2> names{"gicp", "icp"};
  return names;
}

struct ImprovedFloamOptions {
  double min_range = 0.5;
  double max_range = 100.0;
  bool deskew = true;
  OutlierOptions outliers;
  PatchOptions patches;
  FeatureOptions features;
  RegistrationMethod method = RegistrationMethod::gicp;
  AssociationOptions association;
  AlignOptions align{.kernel = Kernel::geman_mcclure, .kernel_width = 4};
  double first_kernel_width = 10.0;
  double first_epsilon = 1e-3;
  PatchMapOptions map;
};

template <class V>
void visit(ImprovedFloamOptions& o, V&& v) {
  v("min_range", o.min_range, Bounds{0, 1e4}, "[m] nearer points are dropped");
  v("max_range", o.max_range, Bounds{0.1, 1e4}, "[m] farther points are dropped");
  v("deskew", o.deskew, "[-] undo the motion within a scan, where points have times");
  v("outliers", o.outliers, "[-] statistical outlier removal");
  v("patches", o.patches, "[-] patches of surface: neighbourhoods and their covariances", kAdvanced);
  v("features", o.features, "[-] edge and plane features among the patches");
  v("method", o.method, "[-] gicp: distribution to distribution; icp: point to point");
  v("association", o.association, "[-] scan to map");
  v("align", o.align, "[-] iterations of the registration");
  v("first_kernel_width", o.first_kernel_width, Bounds{1e-9, 1e9},
    "[-] align.kernel_width, at least, of the first registration, which tells how the scan is straightened", kAdvanced);
  v("first_epsilon", o.first_epsilon, Bounds{0, 1}, "[m, rad] step, at least, at which that stops", kAdvanced);
  v("map", o.map, "[-] local map of edges and planes");
}

class ImprovedFloam : public Odometry {
 public:
  /// `external`: motions of another source, or none.
  explicit ImprovedFloam(const ImprovedFloamOptions& options, std::shared_ptr<const ExternalMotion> external = {})
      : options_(options), outliers_(options.outliers), map_(options.map), external_(std::move(external)) {}
  OdometryResult register_scan(const Scan& scan) override;
  PointCloud local_map() const override;

 private:
  /// Features of a scan, as measured.
  struct FeatureScan {
    SurfacePatches features;
    double stamp, middle;  ///< [s] of the pose, and when that is in the scan
  };

  struct Registration {
    AlignResult alignment = {};
    MotionInScan motion = {};
  };

  Registration register_scan_from(const FeatureScan& scan, const Pose& T_start) const;
  /// Straightened by `motion`, with these options alone.
  Registration register_once(const FeatureScan& scan, const Pose& T_start, const MotionInScan& motion,
                             const AlignOptions& align_options) const;
  AlignResult register_features(MatchedPatches<MapSurface>& features, const Pose& T_start,
                                const AlignOptions& align_options) const;

  Registration find(const FeatureScan& scan);
  /// Where the motion goes on to, and another source where there is one.
  Pose expected(double stamp);
  AlignResult try_from(const FeatureScan& few, const Pose& T_start, const MotionInScan& motion) const;
  MotionInScan in_scan(const Vector6d& velocity, double middle) const;
  /// From several starts, where that from the motion expected is in doubt; says whether they can be told apart.
  Registration search(const FeatureScan& scan, const Registration& expected);
  /// The second scan, if the sensor moved in the first one already.
  Registration search_start(const FeatureScan& scan, const Registration& from_rest);
  bool enough(std::size_t matches) const { return matches >= std::size_t(options_.align.min_matches); }
  bool belongs_in_map(const AlignResult& alignment, double stamp) const;
  void insert(SurfacePatches patches, const FeatureScan& scan, const Registration& registration);
  void straighten_first(const Vector6d& velocity);
  /// A new map, where the sensor is thought to be.
  void begin_anew(double stamp);

  ImprovedFloamOptions options_;
  OutlierFilter outliers_;
  RingLayout rings_;  // of the scan
  ConstantVelocity motion_;
  PatchMap map_;  // of both: it keeps what is flat apart from what is not

  struct FirstScan {
    SurfacePatches patches;
    double middle;
    Pose T_world_middle;
  };
  std::optional<FirstScan> first_;                  // until the second one is in the map
  std::shared_ptr<const ExternalMotion> external_;  // or none
  std::optional<Pose> told_;                        // by it of the last scan
  MotionTrust trust_;                               // in it
  UsualFit usual_{{.poor = 0.7, .sure = 0.8}};      // good runs: 0.78 at least; after a gap it is not straight
  bool ambiguous_ = false;                          // another motion of the last scan fits as well
  bool relative_ = false;                           // the map was begun after a loss
};

}  // namespace tilth
