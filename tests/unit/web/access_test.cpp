// Who may talk to the page's server.
#include <gtest/gtest.h>

#include "tools/web/access.h"

namespace rung::web {
namespace {

TEST(Listen, Addresses) {
  EXPECT_EQ(parseListen("8080")->host, "127.0.0.1");
  EXPECT_EQ(parseListen("8080")->port, 8080);
  EXPECT_EQ(parseListen("192.168.0.5:80")->host, "192.168.0.5");
  EXPECT_EQ(parseListen("[::1]:81")->host, "::1");
  EXPECT_EQ(parseListen("[::1]:81")->port, 81);
  EXPECT_EQ(parseListen("machine")->port, 0);
  for (const char* wrong : {"", ":80", "host:", "host:x", "host:70000", "1:2:3"})
    EXPECT_FALSE(parseListen(wrong).has_value()) << wrong;
}

TEST(Access, ATokenIsSpentOnce) {
  Access access({}, 8080);
  const std::string token = access.newToken();
  EXPECT_FALSE(access.spend(token + "0"));
  EXPECT_FALSE(access.spend(""));
  EXPECT_TRUE(access.spend(token));
  EXPECT_FALSE(access.spend(token));
}

TEST(Access, OldTokensEnd) {
  Access access({}, 8080);
  const std::string first = access.newToken();
  for (int i = 0; i < 8; ++i) (void)access.newToken();
  EXPECT_FALSE(access.spend(first));
}

TEST(Access, TheCookie) {
  Access access({}, 8080);
  const std::string cookie = access.cookie();
  const std::string pair = cookie.substr(0, cookie.find(';'));
  EXPECT_TRUE(access.knows({.cookies = pair}));
  EXPECT_TRUE(access.knows({.cookies = "other=1; " + pair + "; more=2"}));
  EXPECT_FALSE(access.knows({.cookies = pair + "0"}));
  EXPECT_FALSE(access.knows({.cookies = "x" + pair}));
  EXPECT_FALSE(access.knows({.cookies = ""}));
  EXPECT_FALSE(Access({}, 8080).knows({.cookies = pair}));
}

TEST(Access, Hosts) {
  const Access access({.host = "machine"}, 8080);
  const auto refused = [&](const char* host) { return !access.refusal({.method = "GET", .host = host}).empty(); };
  for (const char* host : {"machine:8080", "localhost:8080", "10.0.0.7:8080", "[::1]:8080"})
    EXPECT_FALSE(refused(host)) << host;
  for (const char* host :
       {"machine", "machine:80", "evil.example:8080", "", ":8080", "1.2.3:8080", "10.0.0.7.evil:8080"})
    EXPECT_TRUE(refused(host)) << host;
}

TEST(Access, Origins) {
  const Access access({}, 8080);
  const auto refused = [&](const char* method, const char* origin) {
    return !access.refusal({.method = method, .host = "127.0.0.1:8080", .origin = origin}).empty();
  };
  EXPECT_FALSE(refused("POST", "http://127.0.0.1:8080"));
  EXPECT_FALSE(refused("GET", ""));
  EXPECT_TRUE(refused("POST", ""));
  EXPECT_TRUE(refused("POST", "http://localhost:8080"));
  EXPECT_TRUE(refused("GET", "http://evil.example"));
  EXPECT_TRUE(refused("DELETE", "http://127.0.0.1:8080"));
}

TEST(Query, Values) {
  EXPECT_EQ(queryValue("a=1&b=2%203+4&c", "b"), "2 3 4");
  EXPECT_EQ(queryValue("a=1&b=2", "c"), "");
  EXPECT_EQ(queryValue("c&a=%4", "a"), "%4");
  EXPECT_EQ(queryValue("", "a"), "");
}

} // namespace
} // namespace rung::web
