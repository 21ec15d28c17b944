//! Masses and convex hulls, checked against closed forms.

mod convex;
mod mass;
