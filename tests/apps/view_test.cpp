// tilth view, asked as a browser and as somebody who means harm: over a plain socket, byte by byte.
#include <arpa/inet.h>
#include <chrono>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>

#include <gtest/gtest.h>

#include "program.hpp"

namespace tilth::app {
namespace {

/// What a server on `port` of this machine answers to the line "GET `target`"; empty where nobody listens.
std::string answer(int port, const std::string& target, const std::string& host = "127.0.0.1") {
  const int id = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(std::uint16_t(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string text;
  if (::connect(id, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    const std::string request = "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n";
    if (::send(id, request.data(), request.size(), MSG_NOSIGNAL) == ssize_t(request.size())) {
      char piece[4096];
      for (ssize_t n = 0; (n = ::recv(id, piece, sizeof piece, 0)) > 0;) text.append(piece, std::size_t(n));
    }
  }
  ::close(id);
  return text;
}

int status_of(const std::string& text) {
  return text.size() > 12 ? std::stoi(text.substr(9, 3)) : 0;
}

/// The port that a server says it listens on, once it does.
int port_of(const Program& server) {
  for (int i = 0; i < 600 && server.running(); ++i) {
    const std::string said = server.out_so_far();
    if (const std::size_t at = said.find("127.0.0.1:");
        at != std::string::npos && said.find("ends") != std::string::npos) {
      return std::stoi(said.substr(at + 10));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return 0;
}

/// The local addresses, in hexadecimal, on which sockets of this machine listen at `port`.
std::vector<std::string> listening_addresses(int port) {
  std::vector<std::string> found;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream in(table);
    char wanted[8];
    std::snprintf(wanted, sizeof wanted, ":%04X", unsigned(port) & 0xffffU);
    for (std::string number, local, remote, state, rest; in >> number >> local >> remote >> state;) {
      std::getline(in, rest);
      if (state == "0A" && local.ends_with(wanted)) found.push_back(local.substr(0, local.find(':')));
    }
  }
  return found;
}

class View : public testing::Test {
 protected:
  View() {
    std::filesystem::create_directories(folder_ / "run/plots");
    write("run/report.html", "<p>report</p>");
    write("run/plots/ape.svg", "<svg/>");
    write("run/big.bin", std::string(3'000'000, 'x'));
    write("secret", "secret");
    std::filesystem::create_symlink(folder_ / "secret", folder_ / "run/link");
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::vector<std::string> command(int port) const {
    return {"view", (folder_ / "run").string(), "--port", std::to_string(port)};
  }

  TemporaryFolder folder_;
};

TEST_F(View, ServesTheFilesOfTheFolderAndNoOthers) {
  const Program server(command(0));
  const int port = port_of(server);
  ASSERT_GT(port, 0);
  EXPECT_NE(answer(port, "/").find("<p>report</p>"), std::string::npos);
  EXPECT_NE(answer(port, "/").find("text/html"), std::string::npos);
  EXPECT_NE(answer(port, "/plots/ape.svg").find("image/svg+xml"), std::string::npos);
  EXPECT_GT(answer(port, "/big.bin").size(), 3'000'000U);
  for (const char* target : {"/../secret", "/%2e%2e/secret", "/plots/../../secret", "/..%2fsecret", "//etc/passwd",
                             "/link", "/%2fetc%2fpasswd", "/nothing", "/plots", "/report.html%00.svg", "/..\\secret"}) {
    const std::string text = answer(port, target);
    EXPECT_GE(status_of(text), 400) << target;
    EXPECT_EQ(text.find("\r\n\r\nsecret"), std::string::npos) << target;
  }
  EXPECT_EQ(status_of(answer(port, "/", "elsewhere.example")), 403) << "a name turned to this address";
  EXPECT_EQ(status_of(answer(port, "/", "localhost:" + std::to_string(port))), 200);
  server.signal(SIGINT);
  EXPECT_EQ(server.wait().exit_code, 0);
}

TEST_F(View, ListensOnTheLoopbackInterfaceOnly) {
  const Program server(command(0));
  const int port = port_of(server);
  ASSERT_GT(port, 0);
  EXPECT_EQ(listening_addresses(port), std::vector<std::string>{"0100007F"});
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait().exit_code, 0);
}

TEST_F(View, TakesAnotherPortWhereTheWantedOneIsTaken) {
  const Program first(command(0));
  const int taken = port_of(first);
  ASSERT_GT(taken, 0);
  const Program second(command(taken));
  const int other = port_of(second);
  EXPECT_GT(other, 0);
  EXPECT_NE(other, taken);
  EXPECT_NE(second.out_so_far().find("port " + std::to_string(taken) + " is taken"), std::string::npos);
  for (const Program* server : {&first, &second}) {
    server->signal(SIGINT);
    EXPECT_EQ(server->wait().exit_code, 0);
  }
}

TEST_F(View, RefusesAFolderWithoutAReport) {
  const Outcome none = tilth({"view", (folder_ / "run/plots").string()});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("report.html"), std::string::npos);
  EXPECT_EQ(tilth({"view", (folder_ / "missing").string()}).exit_code, 1);
}

}  // namespace
}  // namespace tilth::app
