#include <algorithm>
#include <cmath>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <tilth/core/error.hpp>
#include <tilth/core/parallel.hpp>
#include <tilth/simulation/mesh_points.hpp>
#include <tilth/simulation/mesh_world.hpp>

namespace tilth {
namespace {

using Eigen::Vector3d;

RTCGeometry geometry_of(RTCDevice device, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), mesh.triangles.size()));
  for (const Vector3d& v : mesh.vertices) vertices = std::copy(v.data(), v.data() + 3, vertices);
  for (const Triangle& t : mesh.triangles) indices = std::copy(t.vertices.begin(), t.vertices.end(), indices);
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCRayHit to_embree(const Ray& ray) {
  RTCRayHit out{};
  out.ray.org_x = float(ray.origin.x()), out.ray.org_y = float(ray.origin.y()), out.ray.org_z = float(ray.origin.z());
  out.ray.dir_x = float(ray.direction.x()), out.ray.dir_y = float(ray.direction.y());
  out.ray.dir_z = float(ray.direction.z());
  out.ray.tfar = std::numeric_limits<float>::infinity();
  out.ray.mask = ~0u;
  out.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return out;
}

/// The nearest point of a mesh so far.
struct NearestPoint {
  const Mesh& mesh;
  Vector3d from;
  double squared = std::numeric_limits<double>::infinity();  ///< [m^2]
};

/// Embree calls this for each triangle within the radius of a query, which shrinks with what was found.
bool look_at_triangle(RTCPointQueryFunctionArguments* found) {
  auto& nearest = *static_cast<NearestPoint*>(found->userPtr);
  const Triangle& triangle = nearest.mesh.triangles[found->primID];
  const double squared = (closest_point(nearest.mesh, triangle, nearest.from) - nearest.from).squaredNorm();
  if (squared >= nearest.squared) return false;
  nearest.squared = squared;
  found->query->radius = std::nextafter(float(std::sqrt(squared)), std::numeric_limits<float>::infinity());
  return true;
}

double distance_to(RTCScene scene, const Mesh& mesh, const Vector3d& point) {
  NearestPoint nearest{mesh, point};
  RTCPointQuery query{};
  query.x = float(point.x()), query.y = float(point.y()), query.z = float(point.z());
  query.radius = std::numeric_limits<float>::infinity();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene, &query, &context, look_at_triangle, &nearest);
  return std::sqrt(nearest.squared);
}

/// Finds what each ray, they lie side by side, meets first.
void intersect(RTCScene scene, std::span<RTCRayHit> rays) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  for (RTCRayHit& ray : rays) rtcIntersect1(scene, &ray, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1M(scene, &context, rays.data(), unsigned(rays.size()), sizeof(RTCRayHit));
#endif
}

}  // namespace

MeshWorld::Facet MeshWorld::facet_of(const Mesh& mesh, const Triangle& triangle) {
  const auto vertex = [&](std::size_t i) -> const Vector3d& { return mesh.vertices[triangle.vertices[i % 3]]; };
  Facet facet;
  facet.normal = (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0)).normalized();
  facet.offset = facet.normal.dot(vertex(0));
  for (std::size_t i = 0; i < 3; ++i) {
    facet.sides[i] = facet.normal.cross(vertex(i + 1) - vertex(i)).normalized();
    facet.side_offsets[i] = facet.sides[i].dot(vertex(i));
  }
  return facet;
}

struct MeshWorld::Tree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  explicit Tree(const Mesh& mesh) : device(rtcNewDevice(nullptr)), scene(rtcNewScene(device)) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = geometry_of(device, mesh);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~Tree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
};

MeshWorld::MeshWorld(Mesh mesh, Movers movers) : mesh_(std::move(mesh)), movers_(std::move(movers)) {
  if (mesh_.triangles.empty()) throw Error("scene", "has no triangle");
  for (const Triangle& triangle : mesh_.triangles) facets_.push_back(facet_of(mesh_, triangle));
  tree_ = std::make_unique<Tree>(mesh_);
}

MeshWorld::~MeshWorld() = default;

/// Embree finds the triangle in float; where the ray meets it is worked out in double.
Hit MeshWorld::hit_of(const Ray& ray, std::uint32_t triangle) const {
  const Facet& facet = facets_[triangle];
  Hit hit;
  hit.surface = &mesh_.surfaces[mesh_.triangles[triangle].surface];
  const double slope = ray.direction.dot(facet.normal);
  hit.normal = slope > 0 ? -facet.normal : facet.normal;
  hit.distance = (facet.offset - ray.origin.dot(facet.normal)) / slope;
  if (hit.surface->slender) hit.edge_distance = 0;
  const Vector3d point = ray.origin + hit.distance * ray.direction;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(mesh_.triangles[triangle].edges >> i & 1)) continue;
    hit.edge_distance = std::min(hit.edge_distance, std::abs(point.dot(facet.sides[i]) - facet.side_offsets[i]));
  }
  return hit;
}

std::vector<Hit> MeshWorld::cast(std::span<const Ray> rays) const {
  std::vector<Hit> hits(rays.size());
  if (rays.empty()) return hits;
  std::vector<RTCRayHit> packet(rays.size());
  std::transform(rays.begin(), rays.end(), packet.begin(), to_embree);
  intersect(tree_->scene, packet);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (packet[i].hit.geomID != RTC_INVALID_GEOMETRY_ID) hits[i] = hit_of(rays[i], packet[i].hit.primID);
  }
  tilth::cast(movers_, rays, hits);
  return hits;
}

std::vector<double> MeshWorld::distances(std::span<const Vector3d> points) const {
  constexpr std::size_t kChunk = 1024;
  std::vector<double> distances(points.size());
  parallel_for(points.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) distances[i] = distance_to(tree_->scene, mesh_, points[i]);
  });
  return distances;
}

}  // namespace tilth
