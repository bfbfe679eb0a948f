#pragma once

namespace fitroom::fit_client {

// Where the servers listen if nothing else is said. Flag before environment before these.
inline constexpr char kBodyServerOption[] = "--body-server";
inline constexpr char kBodyServerVariable[] = "FITROOM_BODY_SERVER";
inline constexpr char kDefaultBodyServer[] = "127.0.0.1:50051";
inline constexpr char kShopServerOption[] = "--shop-server";
inline constexpr char kShopServerVariable[] = "FITROOM_SHOP_SERVER";
inline constexpr char kDefaultShopServer[] = "127.0.0.1:50052";

}  // namespace fitroom::fit_client
