//! Steps in which bodies break: inside the step, or after it within a budget; and questions about blows that have not happened.

pub(crate) mod after;
pub(crate) mod approach;
pub(crate) mod ask;
pub(crate) mod judge;
pub(crate) mod step;
