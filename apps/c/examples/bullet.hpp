// Bodies that break inside a step of Bullet. Before each step the game looks for the touches of that step. A body that breaks is replaced by its
// pieces. They and the striker get their velocities after the blow, and Bullet takes the step with them.
#pragma once
#include <btBulletDynamicsCommon.h>
#include <frangible.hpp>
#include <memory>
#include <vector>

using frangible::ask;
inline frangible_striker material(const char *name) { return ask<frangible_striker>(frangible_striker_of, name); }
template <class T> void put(const T &from, double *to, int count = 3) { for (int k = 0; k < count; k++) to[k] = from[k]; }
inline btVector3 vec(const double *v) { return btVector3(btScalar(v[0]), btScalar(v[1]), btScalar(v[2])); }
inline btQuaternion turn(const double *q) { return btQuaternion(btScalar(q[0]), btScalar(q[1]), btScalar(q[2]), btScalar(q[3])); }

struct Thing { // a rigid body, in its principal axes, which `axes` turns to the frame that it was baked in
    frangible_striker surface;
    frangible::Body body; // none if it cannot break
    frangible_geometry drawn = frangible::sized<frangible_geometry>();
    btTransform axes = btTransform::getIdentity();
    std::unique_ptr<btCollisionShape> shape;
    std::vector<std::unique_ptr<btConvexHullShape>> parts;
    std::unique_ptr<btRigidBody> rigid;
    Thing(const frangible_striker &material, btCollisionShape *form) : surface(material), shape(form) {}
    bool is_ball() const { return shape->getShapeType() == SPHERE_SHAPE_PROXYTYPE; }
    btVector3 velocity(const btVector3 &place) const { return rigid->getVelocityInLocalPoint(place - rigid->getCenterOfMassPosition()); }
};
struct Passing { Thing *piece, *ball; double left; }; // that leave each other alone, for so long, s
struct Blow { Thing *body; std::vector<frangible_contact> contacts; std::vector<Thing *> by; };

struct Game {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
    std::vector<std::unique_ptr<Thing>> things;
    std::vector<Passing> passing;
    std::vector<frangible::Outcome> outcomes; // own the meshes of the pieces
    frangible_report report = frangible::sized<frangible_report>(); // of the last break
    btVector3 impulse{0, 0, 0};                                     // and that of the blow on the body, N s

    explicit Game(double gravity) {
        world.setInternalTickCallback([](btDynamicsWorld *w, btScalar dt) { static_cast<Game *>(w->getWorldUserInfo())->look(dt); }, this, true);
        world.setGravity(btVector3(0, -btScalar(gravity), 0));
        world.getSolverInfo().m_splitImpulsePenetrationThreshold = 0; // margins that overlap give no speed
    }
    ~Game() { while (!things.empty()) remove(things.back().get()); }
    void remove(Thing *thing) {
        world.removeRigidBody(thing->rigid.get());
        for (size_t k = passing.size(); k-- > 0;)
            if (passing[k].piece == thing || passing[k].ball == thing) passing.erase(passing.begin() + std::ptrdiff_t(k));
        for (size_t k = things.size(); k-- > 0;) if (things[k].get() == thing) things.erase(things.begin() + std::ptrdiff_t(k));
    }
    Thing *add(std::unique_ptr<Thing> thing, double mass, const btVector3 &moments, const btTransform &at, const frangible_motion &motion) {
        btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, thing->shape.get(), moments);
        info.m_startWorldTransform = at * thing->axes;
        thing->rigid.reset(new btRigidBody(info));
        thing->rigid->setUserPointer(thing.get());
        thing->rigid->setLinearVelocity(vec(motion.linear));
        thing->rigid->setAngularVelocity(vec(motion.angular));
        world.addRigidBody(thing->rigid.get(), thing->is_ball() ? 32 : 1, -1);
        things.push_back(std::move(thing));
        return things.back().get();
    }
    // A baked body or a fragment, at the pose of the frame that it was baked in.
    Thing *add(const frangible_solid &solid, const frangible_hulls &hulls, const frangible_striker &surface, const btTransform &at,
               const frangible_motion &motion) {
        btCompoundShape *whole = new btCompoundShape();
        std::unique_ptr<Thing> thing(new Thing(surface, whole));
        thing->axes.setRotation(turn(solid.axes));
        for (size_t k = 0, first = 0; k < hulls.count; first = hulls.ends[k++]) {
            btConvexHullShape *part = new btConvexHullShape();
            thing->parts.emplace_back(part);
            part->setMargin(btScalar(2e-4)); // Bullet's own is four centimetres
            for (const float *p = hulls.points + 3 * first; p < hulls.points + 3 * hulls.ends[k]; p += 3)
                part->addPoint(btVector3(p[0], p[1], p[2]), false);
            part->recalcLocalAabb();
            whole->addChildShape(thing->axes.inverse(), part);
        }
        return add(std::move(thing), solid.mass, vec(solid.moments), at, motion);
    }
    void pass(double dt) {
        for (size_t k = passing.size(); k-- > 0;) if ((passing[k].left -= dt) < 0) {
            passing[k].piece->rigid->setIgnoreCollisionCheck(passing[k].ball->rigid.get(), false);
            passing.erase(passing.begin() + std::ptrdiff_t(k));
        }
    }
    void look(btScalar dt) {
        pass(dt);
        world.performDiscreteCollisionDetection();
        std::vector<Thing *> all;
        for (auto &thing : things) all.push_back(thing.get());
        for (Thing *thing : all) if (thing->body) {
            Blow blow{thing, {}, {}};
            for (Thing *ball : all) if (ball->is_ball()) sweep(blow, ball, dt);
            for (int k = 0; k < dispatcher.getNumManifolds(); k++) {
                const btPersistentManifold *pair = dispatcher.getManifoldByIndexInternal(k);
                Thing *a = static_cast<Thing *>(pair->getBody0()->getUserPointer()), *b = static_cast<Thing *>(pair->getBody1()->getUserPointer());
                for (int c = 0; c < pair->getNumContacts() && !a->is_ball() && !b->is_ball(); c++) {
                    const btManifoldPoint &p = pair->getContactPoint(c);
                    if (a == thing) touch(blow, b, p.getPositionWorldOnA(), p.m_normalWorldOnB, p.getDistance(), dt);
                    if (b == thing) touch(blow, a, p.getPositionWorldOnB(), -p.m_normalWorldOnB, p.getDistance(), dt);
                }
            }
            if (!blow.contacts.empty()) strike(blow);
        }
    }
    void sweep(Blow &blow, Thing *ball, btScalar dt) { // a ball may be far away before the step, and behind the body after it
        btTransform from = ball->rigid->getWorldTransform(), to = from;
        to.setOrigin(from.getOrigin() + ball->rigid->getLinearVelocity() * dt);
        btCollisionWorld::ClosestConvexResultCallback hit(from.getOrigin(), to.getOrigin());
        hit.m_collisionFilterMask = 1; // no balls
        world.convexSweepTest(static_cast<btConvexShape *>(ball->shape.get()), from, to, hit);
        if (!hit.hasHit() || hit.m_hitCollisionObject != blow.body->rigid.get()) return;
        from.setOrigin(from.getOrigin().lerp(to.getOrigin(), hit.m_closestHitFraction));
        ball->rigid->setWorldTransform(from);
        touch(blow, ball, hit.m_hitPointWorld, -hit.m_hitNormalWorld, 0, dt);
    }
    void touch(Blow &blow, Thing *by, const btVector3 &point, const btVector3 &normal, btScalar gap, btScalar dt) {
        frangible_contact contact = frangible::sized<frangible_contact>();
        contact.speed = (by->velocity(point) - blow.body->velocity(point)).dot(normal);
        if (contact.speed <= 0 || gap > contact.speed * dt) return;
        while (contact.striker < blow.by.size() && blow.by[contact.striker] != by) contact.striker++;
        if (contact.striker == blow.by.size()) blow.by.push_back(by);
        put(point, contact.point);
        put(normal, contact.normal);
        blow.contacts.push_back(contact);
    }
    static frangible_motion motion(const Thing &thing) {
        frangible_motion motion;
        put(thing.rigid->getLinearVelocity(), motion.linear);
        put(thing.rigid->getAngularVelocity(), motion.angular);
        return motion;
    }
    static frangible_striker striker(const Thing &by, const Thing &body) {
        frangible_striker s = by.surface;
        s.restitution = 0.5 * (s.restitution + body.surface.restitution); // of the pair
        s.kind = by.rigid->getInvMass() == 0 ? FRANGIBLE_STRIKER_FIXED : by.is_ball() ? FRANGIBLE_STRIKER_BALL : FRANGIBLE_STRIKER_BODY;
        const btMatrix3x3 inertia = by.rigid->getInvInertiaTensorWorld().inverse();
        for (int k = 0; k < 3; k++) put(inertia.getColumn(k), s.inertia + 3 * k);
        s.mass = 1.0 / by.rigid->getInvMass();
        put(by.rigid->getCenterOfMassPosition(), s.centre);
        s.motion = motion(by);
        return s;
    }
    void strike(const Blow &blow) {
        std::vector<frangible_striker> by;
        for (Thing *thing : blow.by) by.push_back(striker(*thing, *blow.body));
        const btTransform at = blow.body->rigid->getWorldTransform() * blow.body->axes.inverse();
        frangible_pose pose;
        put(at.getOrigin(), pose.position);
        put(at.getRotation(), pose.rotation, 4);
        frangible::Outcome outcome = ask<frangible_outcome>(frangible_body_impact, blow.body->body, blow.contacts.data(),
                                                            blow.contacts.size(), by.data(), by.size(), &pose);
        const auto found = ask<frangible_report>(frangible_outcome_report, outcome);
        if (!found.broke && !found.contacts) return; // a bound has refused it: Bullet's own contact counts
        const size_t count = found.broke ? found.fragments : 1;
        std::vector<frangible_pose> poses(count);
        std::vector<frangible_motion> motions(count);
        const frangible_motion before = motion(*blow.body);
        // Of several strikers that give way, only the first is moved here.
        const auto after =
            ask<frangible_motion>(frangible_outcome_motions, outcome, &pose, &before, by.data(), poses.data(), motions.data(), count);
        if (by[0].kind != FRANGIBLE_STRIKER_FIXED) move(*blow.by[0], after);
        if (!found.broke) return move(*blow.body, motions[0]);
        impulse = at.getBasis() * vec(found.impulse);
        report = found;
        for (size_t k = 0; k < found.fragments; k++) {
            const auto solid = ask<frangible_solid>(frangible_outcome_solid, outcome, k);
            const auto hulls = ask<frangible_hulls>(frangible_outcome_hulls, outcome, k);
            Thing *piece = add(solid, hulls, blow.body->surface, btTransform(at.getRotation(), vec(poses[k].position)), motions[k]);
            piece->drawn = ask<frangible_geometry>(frangible_outcome_geometry, outcome, k);
            if (blow.by[0]->is_ball()) { // what a ball meets of the pieces is in the motions
                piece->rigid->setIgnoreCollisionCheck(blow.by[0]->rigid.get(), true);
                passing.push_back({piece, blow.by[0], 0.25});
            }
        }
        remove(blow.body);
        outcomes.push_back(std::move(outcome));
    }
    static void move(Thing &thing, const frangible_motion &motion) {
        thing.rigid->setLinearVelocity(vec(motion.linear));
        thing.rigid->setAngularVelocity(vec(motion.angular));
    }
    btVector3 momentum() const { // of all that moves, N s
        btVector3 sum(0, 0, 0);
        for (auto &t : things) if (t->rigid->getInvMass() > 0) sum += t->rigid->getLinearVelocity() / t->rigid->getInvMass();
        return sum;
    }
};
