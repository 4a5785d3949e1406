// tilth view: serves the report of a result folder to a browser on this machine, and to nobody else.
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <httplib.h>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>

#include "commands.hpp"
#include <tilth/core/error.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLoopback = "127.0.0.1";
constexpr int kPort = 8080;
constexpr const char* kPage = "report.html";
constexpr std::size_t kPiece = 1 << 18;  // [bytes] read at a time

struct ViewArguments {
  std::string folder;
  int port = kPort;
};

/// The file of `folder` that a request names; empty where there is no such file in it, however the name is put.
fs::path file_of(const fs::path& folder, const std::string& request) {
  if (request.find('\0') != std::string::npos) return {};
  const std::string name = request == "/" ? kPage : request.substr(1);
  std::error_code error;
  const fs::path file = fs::canonical(folder / fs::path(name).relative_path(), error);
  if (error || !fs::is_regular_file(file, error)) return {};
  const fs::path within = file.lexically_relative(folder);
  return within.empty() || *within.begin() == ".." ? fs::path() : file;
}

const char* content_type(const fs::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".html") return "text/html; charset=utf-8";
  if (extension == ".svg") return "image/svg+xml";
  if (extension == ".json") return "application/json";
  if (extension == ".csv" || extension == ".txt" || extension == ".tum") return "text/plain; charset=utf-8";
  return "application/octet-stream";
}

/// Sends `file` piece by piece: maps may be large.
void send_file(const fs::path& file, httplib::Response& response) {
  const auto in = std::make_shared<std::ifstream>(file, std::ios::binary);
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Cache-Control", "no-store");
  response.set_content_provider(fs::file_size(file), content_type(file),
                                [in](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                                  std::string piece(std::min(length, kPiece), '\0');
                                  in->clear();
                                  in->seekg(std::streamoff(offset));
                                  in->read(piece.data(), std::streamsize(piece.size()));
                                  return in->gcount() > 0 && sink.write(piece.data(), std::size_t(in->gcount()));
                                });
}

/// Whether a browser asked for this machine by name: a page of elsewhere whose name was turned to this address did not.
bool asks_for_loopback(const httplib::Request& request) {
  const std::string host = request.get_header_value("Host");
  const std::string name = host.substr(0, host.rfind(':'));
  return name == kLoopback || name == "localhost";
}

void set_answers(httplib::Server& server, const fs::path& folder) {
  server.Get(".*", [folder](const httplib::Request& request, httplib::Response& response) {
    const fs::path file = file_of(folder, request.path);
    response.status = file.empty() ? 404 : 200;
    if (!asks_for_loopback(request)) response.status = 403;
    if (response.status == 200) send_file(file, response);
  });
}

/// The wanted port, or any that is free.
int bind(httplib::Server& server, int wanted) {
  server.set_socket_options([](socket_t socket) {  // without the library's SO_REUSEPORT, which hides that it is taken
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  if (wanted != 0 && server.bind_to_port(kLoopback, wanted)) return wanted;
  const int port = server.bind_to_any_port(kLoopback);
  if (port <= 0) throw Error("view", std::string("no port of ") + kLoopback + " is free");
  if (wanted != 0) std::printf("port %d is taken\n", wanted);
  return port;
}

void serve_until_interrupted(httplib::Server& server) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread serving([&] { server.listen_after_bind(); });
  int signal = 0;
  sigwait(&signals, &signal);
  server.stop();
  serving.join();
}

void view(const ViewArguments& arguments) {
  std::error_code error;
  const fs::path folder = fs::canonical(arguments.folder, error);
  if (error) throw Error(arguments.folder, error.message());
  if (!fs::is_regular_file(folder / kPage)) {
    throw Error(arguments.folder, std::string("holds no ") + kPage + ": is it a folder that `tilth run` wrote?");
  }
  httplib::Server server;
  set_answers(server, folder);
  const int port = bind(server, arguments.port);
  std::printf("http://%s:%d/\nCtrl-C ends\n", kLoopback, port);
  std::fflush(stdout);
  serve_until_interrupted(server);
}

}  // namespace

void add_view(CLI::App& app, int&) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = app.add_subcommand("view", "Show the report of a result folder in a browser on this machine");
  command->add_option("DIR", arguments->folder, "folder that `tilth run` wrote")->required();
  command->add_option("--port", arguments->port, "wanted port; another one where it is taken; 0: any")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
  command->callback([arguments] { view(*arguments); });
}

}  // namespace tilth::app
