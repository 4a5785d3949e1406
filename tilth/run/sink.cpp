#include <exception>
#include <utility>

#include <tilth/run/sink.hpp>

namespace tilth {
namespace {

using Write = std::function<void(const std::filesystem::path&, const RunRecord&)>;

class FileSink final : public Sink {
 public:
  FileSink(std::filesystem::path path, Write write) : path_(std::move(path)), write_(std::move(write)) {}
  void finish(const RunRecord& record) override { write_(path_, record); }

 private:
  std::filesystem::path path_;
  Write write_;
};

}  // namespace

void Sink::take(const Scan&, const OdometryResult&, const RunRecord&) {}

std::vector<std::string> finish_all(std::span<const std::unique_ptr<Sink>> sinks, const RunRecord& record) {
  std::vector<std::string> failures;
  for (const std::unique_ptr<Sink>& sink : sinks) {
    try {
      sink->finish(record);
    } catch (const std::exception& e) {
      failures.emplace_back(e.what());
    }
  }
  return failures;
}

std::unique_ptr<Sink> file_sink(std::filesystem::path path, Write write) {
  return std::make_unique<FileSink>(std::move(path), std::move(write));
}

}  // namespace tilth
