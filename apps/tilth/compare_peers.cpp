#include "compare_peers.hpp"

#include "child_process.hpp"
#include "number_list.hpp"
#include "task_engine.hpp"
#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

constexpr int kMissing = 77;  // exit code of the script

std::string words_of(const fs::path& file) {
  const std::vector<std::byte> bytes = read_file(file);
  std::string text(as_text(bytes));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

fs::path peer_script() {
  return script_file("run_peer.py");
}

Method peer_method(const std::string& name, const std::string& words, const MatrixArguments& arguments) {
  Command run{arguments.python, peer_script().string(), name, "{scans}", "{out}"};
  if (arguments.max_scans > 0) run.insert(run.end(), {"--max-scans", std::to_string(arguments.max_scans)});
  const std::string program = words + " " + fingerprint(peer_script());
  return {name, {run}, program};
}

}  // namespace

Peers find_peers(const std::string& list, const MatrixArguments& arguments) {
  Peers peers;
  if (list.empty()) return peers;
  fs::create_directories(arguments.out);
  for (const std::string& name : parse_word_list("--peers", list)) {
    const fs::path log = fs::path(arguments.out) / "peer.txt";
    fs::remove(log);
    const ChildEnd end = run_child({arguments.python, peer_script().string(), name, "--check"}, log);
    const std::string words = words_of(log);
    fs::remove(log);
    if (end.exit_code == kMissing) {
      peers.skipped.push_back(name + ": " + words);
    } else if (end.exit_code != 0 || end.signal != 0) {
      throw Error("--peers " + name, "cannot be run: " + words);
    } else {
      peers.used.push_back(name + " is " + words);
      peers.methods.push_back(peer_method(name, words, arguments));
    }
  }
  return peers;
}

}  // namespace tilth::app
