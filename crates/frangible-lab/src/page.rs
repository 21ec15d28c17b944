//! Pages of the documentation: Markdown with pictures beside it.

/// Text and pictures.
#[derive(Clone, Debug)]
pub struct Page {
    /// Markdown.
    pub text: String,
    /// Name of each picture's file without the ending, and the PNG.
    pub pictures: Vec<(String, Vec<u8>)>,
}

/// A table of names and numbers: the first column to the left, the others to the right.
#[must_use]
pub fn table<S: AsRef<str>>(head: &[S], rows: &[Vec<String>]) -> String {
    let rule = format!("|---|{}", "---:|".repeat(head.len().saturating_sub(1)));
    lines(head, &rule, rows)
}

/// A table of words, all columns to the left.
#[must_use]
pub fn table_of_words<S: AsRef<str>>(head: &[S], rows: &[Vec<String>]) -> String {
    lines(head, &format!("|{}", "---|".repeat(head.len())), rows)
}

fn lines<S: AsRef<str>>(head: &[S], rule: &str, rows: &[Vec<String>]) -> String {
    let head: Vec<&str> = head.iter().map(AsRef::as_ref).collect();
    let mut text = format!("| {} |\n{rule}\n", head.join(" | "));
    for row in rows {
        text += &format!("| {} |\n", row.join(" | "));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{table, table_of_words};

    #[test]
    fn numbers_stand_to_the_right_and_words_to_the_left() {
        let rows = [vec!["a".to_owned(), "1".to_owned()]];
        let numbers = "| of | N |\n|---|---:|\n| a | 1 |\n";
        assert_eq!(table(&["of", "N"], &rows), numbers);
        assert_eq!(
            table_of_words(&["of", "N"], &rows),
            numbers.replace("---:", "---")
        );
    }
}
