declare module "*.css" {
  /** Its text, where tests read it. */
  const text: string;
  export default text;
}
