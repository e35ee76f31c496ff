// Lines between two processes, of a bounded length, without waiting.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace rung::control {

class Connection {
public:
  static constexpr size_t kLongestRequest = size_t{64} << 10;
  static constexpr size_t kLongestAnswer = size_t{4} << 20; // and the most that waits until the other side takes it

  // Of a socket, which it closes; `longest` is the longest line that it takes.
  Connection(int socket, size_t longest) : socket_(socket), longest_(longest) {}
  Connection(Connection&& other) noexcept;
  Connection& operator=(Connection&& other) noexcept;
  ~Connection();

  int socket() const { return socket_; }
  // The other side has gone, or breaks the rules: `problem` says which. No more is read or sent.
  bool ended() const { return ended_; }
  const std::string& problem() const { return problem_; }
  bool wantsToSend() const { return !ended_ && !out_.empty(); }

  // Takes what has come.
  void receive();
  bool hasLine() const { return in_.find('\n') != std::string::npos; }
  // The next whole line, without its end.
  std::optional<std::string> line();
  // A line; sent as far as the other side takes it.
  void send(std::string_view line);
  void sendMore();
  // After what is sent.
  void end(std::string problem);

private:
  int socket_ = -1;
  size_t longest_;
  bool ended_ = false;
  std::string problem_;
  std::string in_, out_;
};

} // namespace rung::control
