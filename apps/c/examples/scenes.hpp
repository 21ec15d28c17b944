// Scenes of the examples.
#pragma once
#include "bullet.hpp"

/// Adds a body of a kind.
inline void add_body(Game &game, frangible_breakable kind, uint64_t seed, const btTransform &at) {
    const auto solid = ask<frangible_solid>(frangible_breakable_solid, kind);
    const auto hulls = ask<frangible_hulls>(frangible_breakable_hulls, kind);
    Thing *body = game.add(solid, hulls, material("glass"), at, frangible_motion());
    body->body = ask<frangible_body>(frangible_body_new, kind, seed);
    body->drawn = ask<frangible_geometry>(frangible_breakable_geometry, kind);
}

/// Adds a body that is free, and a steel ball of 130 g that flies at it along -z, a little off its middle. Returns the ball.
inline Thing *ball_at(Game &game, frangible_breakable kind, uint64_t seed, double speed) {
    add_body(game, kind, seed, btTransform::getIdentity());
    const btScalar radius = btScalar(0.0158);
    frangible_striker steel = material("steel");
    steel.radius = radius;
    std::unique_ptr<Thing> ball(new Thing(steel, new btSphereShape(radius)));
    const double mass = 7850 * 4.0 / 3.0 * SIMD_PI * radius * radius * radius;
    btVector3 moments;
    ball->shape->calculateLocalInertia(btScalar(mass), moments);
    const btTransform at(btQuaternion::getIdentity(), btVector3(btScalar(0.01), btScalar(0.005), btScalar(0.1)));
    return game.add(std::move(ball), mass, moments, at, {{0, 0, -speed}, {0, 0, 0}});
}

/// Adds a floor of stone, and a glass that falls on it from this height, with the edge of its foot first.
inline void glass_falls(Game &game, frangible_breakable kind, uint64_t seed, double height) {
    std::unique_ptr<Thing> floor(new Thing(material("stone"), new btStaticPlaneShape(btVector3(0, 1, 0), 0)));
    game.add(std::move(floor), 0, btVector3(0, 0, 0), btTransform::getIdentity(), frangible_motion());
    const btQuaternion tilted = btQuaternion(btVector3(0, 0, 1), btScalar(0.6)) * btQuaternion(btVector3(1, 0, 0), -SIMD_HALF_PI);
    add_body(game, kind, seed, btTransform(tilted, btVector3(0, btScalar(height), 0)));
}
