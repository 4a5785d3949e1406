#include <algorithm>
#include <cmath>

#include <embree3/rtcore.h>

#include <tilth/core/error.hpp>
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

double distance_to_line(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  return (point - a).cross(b - a).norm() / (b - a).norm();
}

}  // namespace

struct MeshWorld::Tree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  explicit Tree(const Mesh& mesh) : device(rtcNewDevice("threads=1")), scene(rtcNewScene(device)) {
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
  tree_ = std::make_unique<Tree>(mesh_);
}

MeshWorld::~MeshWorld() = default;

/// Embree finds the triangle in float; where the ray meets it is worked out in double.
Hit MeshWorld::hit_of(const Ray& ray, std::uint32_t triangle) const {
  const Triangle& t = mesh_.triangles[triangle];
  const std::array<Vector3d, 3> v{mesh_.vertices[t.vertices[0]], mesh_.vertices[t.vertices[1]],
                                  mesh_.vertices[t.vertices[2]]};
  Hit hit;
  hit.normal = (v[1] - v[0]).cross(v[2] - v[0]).normalized();
  if (hit.normal.dot(ray.direction) > 0) hit.normal = -hit.normal;
  hit.distance = (v[0] - ray.origin).dot(hit.normal) / ray.direction.dot(hit.normal);
  hit.surface = &mesh_.surfaces[t.surface];
  if (hit.surface->slender) hit.edge_distance = 0;
  const Vector3d point = ray.origin + hit.distance * ray.direction;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(t.edges >> i & 1)) continue;
    hit.edge_distance = std::min(hit.edge_distance, distance_to_line(point, v[i], v[(i + 1) % 3]));
  }
  return hit;
}

std::vector<Hit> MeshWorld::cast(std::span<const Ray> rays) const {
  std::vector<Hit> hits(rays.size());
  if (rays.empty()) return hits;
  std::vector<RTCRayHit> packet(rays.size());
  std::transform(rays.begin(), rays.end(), packet.begin(), to_embree);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1M(tree_->scene, &context, packet.data(), unsigned(packet.size()), sizeof(RTCRayHit));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (packet[i].hit.geomID != RTC_INVALID_GEOMETRY_ID) hits[i] = hit_of(rays[i], packet[i].hit.primID);
  }
  tilth::cast(movers_, rays, hits);
  return hits;
}

}  // namespace tilth
