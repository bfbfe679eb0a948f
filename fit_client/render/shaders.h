#pragma once

// The shaders' source text. Colours are lit in a space of squared values (sRGB is close to the square root of light),
// so that a texture that is lit by exactly 1 leaves the shader with the bytes it came in with.
namespace fitroom::render::shaders {

extern const char kBackdropVertex[];
extern const char kBackdropFragment[];
extern const char kGroundVertex[];
extern const char kGroundFragment[];
extern const char kBodyVertex[];
extern const char kBodyFragment[];
extern const char kClothVertex[];
extern const char kClothFragment[];
extern const char kLineVertex[];
extern const char kLineFragment[];

}  // namespace fitroom::render::shaders
