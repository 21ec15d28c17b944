// What a scene of Bullet looks like, as text, for `cargo run --release -p frangible-lab --example bullet_pictures`: `frames pane pane.frangible`.
// Lines: `mesh ID VERTICES INDICES OUTER` and its numbers, `ball ID RADIUS`, `at FRAME ID POSITION ROTATION`, `broke FRAME`.
#include "scenes.hpp"
#include <cstdio>
#include <map>
#include <string>

static void numbers(const float *values, size_t count) {
    for (size_t k = 0; k < count; k++) std::printf("%.7g ", double(values[k]));
    std::printf("\n");
}
/// Tells of a thing that is seen for the first time.
static void shape(const Thing &thing, size_t id) {
    if (thing.is_ball()) return void(std::printf("ball %zu %g\n", id, thing.surface.radius));
    const frangible_geometry &mesh = thing.drawn;
    std::printf("mesh %zu %zu %zu %zu\n", id, mesh.vertices, mesh.indices_count, mesh.outer_indices);
    numbers(mesh.positions, 3 * mesh.vertices);
    numbers(mesh.normals, 3 * mesh.vertices);
    for (size_t k = 0; k < mesh.indices_count; k++) std::printf("%u ", unsigned(mesh.indices[k]));
    std::printf("\n");
}
static void run(const std::string &scene, const char *file) {
    const frangible::Breakable kind = ask<frangible_breakable>(frangible_breakable_load, file);
    const bool falls = scene == "glass";
    Game game(falls ? 9.81 : 0);
    if (falls) glass_falls(game, kind, 1, 1.2);
    else ball_at(game, kind, 1, 12);
    std::map<const Thing *, size_t> known;
    bool broken = false;
    for (int frame = 0; frame < (falls ? 260 : 40); frame++) {
        game.world.stepSimulation(btScalar(1.0 / 240), 0);
        if (game.report.broke && !broken) std::printf("broke %d\n", frame);
        if (game.report.broke && !broken) known.clear(); // a piece may lie where the whole body lay
        broken = game.report.broke == 1;
        for (auto &thing : game.things) if (thing->rigid->getInvMass() > 0) {
            static size_t next = 0;
            if (!known.count(thing.get())) shape(*thing, known[thing.get()] = next++);
            const btTransform at = thing->rigid->getWorldTransform() * thing->axes.inverse();
            const btVector3 p = at.getOrigin();
            const btQuaternion q = at.getRotation();
            std::printf("at %d %zu %.7g %.7g %.7g %.7g %.7g %.7g %.7g\n", frame, known[thing.get()], p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
        }
    }
}

int main(int count, char **words) try {
    if (count < 3) return std::printf("frames pane|glass FILE.frangible\n"), 2;
    return run(words[1], words[2]), 0;
} catch (const std::exception &error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
}
