// @ts-nocheck: it is bundled as JavaScript, as a user would write it.
export default function Layout({ children }) {
  return (
    <html lang="en">
      <body>{children}</body>
    </html>
  );
}
