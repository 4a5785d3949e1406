// A recording becomes a folder with trajectory, map and report, as `tilth run` makes it, and one file of your own.
//
//   04_run_a_recording RECORDING FOLDER
#include <filesystem>
#include <fstream>
#include <iostream>

#include <tilth/odometry/make_odometry.hpp>
#include <tilth/report/run_outputs.hpp>
#include <tilth/run/new_record.hpp>
#include <tilth/run/session.hpp>
#include <tilth/sources/open_source.hpp>

/// A line for every scan, at once: "stamp matches".
class MatchesFile : public tilth::Sink {
 public:
  explicit MatchesFile(const std::filesystem::path& path) : out_(path) {}
  void take(const tilth::Scan&, const tilth::OdometryResult& result, const tilth::RunRecord&) override {
    out_ << std::fixed << result.stamp << ' ' << result.alignment.matches << std::endl;
  }
  void finish(const tilth::RunRecord&) override {}

 private:
  std::ofstream out_;
};

int main(int argc, char** argv) try {
  if (argc != 3) return std::cerr << "usage: 04_run_a_recording RECORDING FOLDER\n", 2;
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder);

  tilth::Session session(tilth::open_source(argv[1], {}), {tilth::make_odometry("tilth", {})},
                         tilth::new_record(argv[1], "tilth", {}));
  for (const tilth::RunOutput& output : tilth::run_outputs({}, {}, false))
    session.add(output.open(folder / output.file));
  session.add(std::make_unique<MatchesFile>(folder / "matches.txt"));

  session.run();
  const std::vector<std::string> failures = session.finish();
  for (const std::string& failure : failures) std::cerr << failure << '\n';
  std::cout << session.record().trajectory.size() << " scans, " << session.record().ended << '\n';
  return failures.empty() ? 0 : 1;
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
