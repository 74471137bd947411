//! Undo and redo over whole documents, one step a gesture.

/// Past and future of a value; the present lies outside.
#[derive(Clone, Debug)]
pub(super) struct History<T> {
    past: Vec<T>,
    future: Vec<T>,
    /// What stood when the running gesture began.
    gesture: Option<T>,
}

/// Steps that are kept.
const DEPTH: usize = 200;

impl<T> Default for History<T> {
    fn default() -> Self {
        Self { past: Vec::new(), future: Vec::new(), gesture: None }
    }
}

impl<T: Clone + PartialEq> History<T> {
    /// To be called before `present` changes. Within a gesture only its beginning is kept.
    pub(super) fn before_change(&mut self, present: &T) {
        if self.gesture.is_none() {
            self.push(present.clone());
        }
    }

    /// What follows, until the end, is one step. Nothing happens when a gesture is running.
    pub(super) fn begin_gesture(&mut self, present: &T) {
        self.gesture.get_or_insert_with(|| present.clone());
    }

    /// Ends the gesture, if one runs; without a change it leaves no step.
    pub(super) fn end_gesture(&mut self, present: &T) {
        if let Some(start) = self.gesture.take().filter(|start| start != present) {
            self.push(start);
        }
    }

    fn push(&mut self, step: T) {
        self.future.clear();
        if self.past.len() == DEPTH {
            self.past.remove(0);
        }
        self.past.push(step);
    }

    /// Goes one step back. True when there was one.
    pub(super) fn undo(&mut self, present: &mut T) -> bool {
        self.end_gesture(present);
        let Some(before) = self.past.pop() else { return false };
        self.future.push(std::mem::replace(present, before));
        true
    }

    /// Takes one step back back. True when there was one.
    pub(super) fn redo(&mut self, present: &mut T) -> bool {
        self.end_gesture(present);
        let Some(after) = self.future.pop() else { return false };
        self.past.push(std::mem::replace(present, after));
        true
    }

    pub(super) fn can_undo(&self) -> bool {
        !self.past.is_empty() || self.gesture.is_some()
    }

    pub(super) fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_over_many_values_is_one_step() {
        let mut history = History::default();
        let mut value = 1;
        history.begin_gesture(&value);
        for step in 2..9 {
            history.before_change(&value);
            value = step;
        }
        history.end_gesture(&value);
        assert!(history.undo(&mut value));
        assert_eq!(value, 1);
        assert!(!history.undo(&mut value));
        assert!(history.redo(&mut value));
        assert_eq!(value, 8);
    }

    #[test]
    fn a_change_after_undo_ends_the_old_future() {
        let mut history = History::default();
        let mut value = 1;
        history.before_change(&value);
        value = 2;
        history.undo(&mut value);
        history.before_change(&value);
        value = 3;
        assert!(!history.can_redo());
        assert!(!history.redo(&mut value));
        assert_eq!(value, 3);
    }

    #[test]
    fn a_gesture_without_change_leaves_no_step() {
        let mut history = History::default();
        let value = 1;
        history.begin_gesture(&value);
        history.end_gesture(&value);
        assert!(!history.can_undo());
    }
}
